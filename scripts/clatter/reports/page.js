"use strict";
// Shows the numbers of a point, its motion and its command when a place of the picture is chosen.

const svgNames = "http://www.w3.org/2000/svg";

const bytesOf = async (text) => {
  const packed = Uint8Array.from(atob(text), (sign) => sign.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Response(stream).arrayBuffer();
};
const doubles = async (text) => new Float64Array(await bytesOf(text));

// A number with the digits that read back to it, as a command takes it.
const written = (value) => (value === Infinity ? "inf" : value === -Infinity ? "-inf" : String(value));

// A number of the page's JSON, which has infinite ones as texts.
const fromJson = (value) => (value === "inf" ? Infinity : value === "-inf" ? -Infinity : value);

const element = (name, properties = {}, ...children) => {
  const made = Object.assign(document.createElement(name), properties);
  made.append(...children);
  return made;
};
const drawn = (name, attributes) => {
  const made = document.createElementNS(svgNames, name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  return made;
};
const clamp = (value, low, high) => Math.min(high, Math.max(low, value));

// The share of a panel's width or height, from the lower left, at which a value lies.
const share = (panel, side, value) => {
  const scale = panel.log[side] ? Math.log : (number) => number;
  const [low, high] = panel.limits.slice(2 * side, 2 * side + 2).map(scale);
  return (scale(value) - low) / (high - low);
};

class Explorer {
  constructor(section, data) {
    this.section = section;
    this.data = data;
    this.picture = section.querySelector(".picture");
    this.side = section.querySelector(".point");
    this.chosen = data.shape.map((length) => Math.floor((length - 1) / 2)); // an index along each axis
  }

  async begin() {
    const { data } = this;
    if (!data.columns) return this.section.querySelector(".explorer").classList.add("still");
    for (const axis of data.axes) axis.values = await doubles(axis.values);
    for (const part of data.command) if (part.values) part.values = await doubles(part.values);
    for (const column of data.columns) column.values = await doubles(column.values);
    this.byName = Object.fromEntries(data.columns.map((column) => [column.name, column]));
    if (data.shape.some((length) => length > 1)) {
      this.picture.classList.add("live");
      this.picture.addEventListener("click", (event) => this.click(event));
      this.picture.addEventListener("keydown", (event) => this.key(event));
    } else {
      this.picture.removeAttribute("tabindex");
    }
    await this.show();
  }

  flat(index = this.chosen) {
    return index.reduce((sum, place, axis) => sum * this.data.shape[axis] + place, 0);
  }

  click(event) {
    const image = this.picture.querySelector("img").getBoundingClientRect();
    const x = (event.clientX - image.left) / image.width, y = (event.clientY - image.top) / image.height;
    const panel = this.data.panels.find(({ box }) => x >= box[0] && x <= box[2] && y >= box[1] && y <= box[3]);
    if (!panel) return;
    const [left, top, right, bottom] = panel.box;
    const at = [(x - left) / (right - left), (bottom - y) / (bottom - top)];
    if (panel.columns) {
      this.chosen = [this.nearestPoint(panel, at, image)];
    } else {
      panel.axes.forEach((axis, side) => (this.chosen[axis] = this.nearestValue(panel, side, axis, at[side])));
    }
    this.picture.focus({ preventScroll: true });
    this.show();
  }

  nearestValue(panel, side, axis, at) {
    let best = 0, least = Infinity;
    this.data.axes[axis].values.forEach((value, place) => {
      const away = Math.abs(share(panel, side, value) - at);
      if (away < least) [best, least] = [place, away];
    });
    return best;
  }

  nearestPoint(panel, at, image) {
    const [across, along] = panel.columns.map((name) => this.byName[name].values);
    const width = (panel.box[2] - panel.box[0]) * image.width, height = (panel.box[3] - panel.box[1]) * image.height;
    let best = 0, least = Infinity;
    across.forEach((value, place) => {
      const away = Math.hypot((share(panel, 0, value) - at[0]) * width, (share(panel, 1, along[place]) - at[1]) * height);
      if (away < least) [best, least] = [place, away];
    });
    return best;
  }

  key(event) {
    const moves = { ArrowRight: [0, 1], ArrowLeft: [0, -1], ArrowUp: [1, 1], ArrowDown: [1, -1] };
    const shown = (this.data.panels.find((panel) => panel.axes) || { axes: [0] }).axes;
    const axes = [...shown, ...this.data.shape.keys()].filter((axis, place, all) => all.indexOf(axis) === place);
    if (event.key in moves) {
      const [side, step] = moves[event.key];
      if (side >= axes.length) return;
      this.step(axes[side], step * (event.shiftKey ? 10 : 1));
    } else if (event.key === "Home") {
      this.step(axes[0], -Infinity);
    } else if (event.key === "End") {
      this.step(axes[0], Infinity);
    } else {
      return;
    }
    event.preventDefault();
  }

  step(axis, by) {
    this.chosen[axis] = clamp(this.chosen[axis] + by, 0, this.data.shape[axis] - 1);
    this.show();
  }

  async show() {
    this.mark();
    const parts = [this.steps(), this.numbers()];
    parts.push(this.command(), await this.history());
    this.side.replaceChildren(...parts.filter(Boolean));
  }

  mark() {
    this.picture.querySelectorAll(".mark").forEach((mark) => mark.remove());
    const frame = this.picture.querySelector(".frame");
    const add = (kind, left, top, width, height) => {
      const mark = element("div", { className: `mark ${kind}` });
      Object.assign(mark.style, { left: `${left * 100}%`, top: `${top * 100}%` });
      if (width) mark.style.width = `${width * 100}%`;
      if (height) mark.style.height = `${height * 100}%`;
      frame.append(mark);
    };
    for (const panel of this.data.panels) {
      const values = panel.columns
        ? panel.columns.map((name) => this.byName[name].values[this.chosen[0]])
        : panel.axes.map((axis) => this.data.axes[axis].values[this.chosen[axis]]);
      const [left, top, right, bottom] = panel.box;
      const x = left + share(panel, 0, values[0]) * (right - left);
      if (!(x >= left - 1e-6 && x <= right + 1e-6)) continue;
      if (values.length === 1) {
        add("across", x, top, 0, bottom - top);
        continue;
      }
      const y = bottom - share(panel, 1, values[1]) * (bottom - top);
      if (!(y >= top - 1e-6 && y <= bottom + 1e-6)) continue;
      add("across", x, top, 0, bottom - top);
      add("along", left, y, right - left, 0);
      add("dot", x, y, 0, 0);
    }
  }

  // Where the point lies, with buttons to its neighbours.
  steps() {
    const box = element("div", { className: "steps" });
    const shape = this.data.shape;
    const entries = this.data.axes.length ? this.data.axes : shape.map(() => ({ name: "point", title: "along all branches", values: null }));
    entries.forEach((axis, place) => {
      const button = (text, by, name) => {
        const made = element("button", { type: "button", textContent: text });
        made.setAttribute("aria-label", `${name} ${axis.name}`);
        made.addEventListener("click", () => this.step(place, by));
        return made;
      };
      const value = axis.values ? written(axis.values[this.chosen[place]]) : `${this.chosen[place] + 1} of ${shape[place]}`;
      box.append(button("◀", -1, "previous"), button("▶", 1, "next"), element("span", {}, element("b", { textContent: axis.name }), ` ${axis.title}`),
        element("span", { className: "value", textContent: value }));
    });
    return box;
  }

  text(column) {
    const value = column.values[this.flat()];
    if (column.texts) return column.texts[value] || "–";
    return Number.isNaN(value) ? "–" : written(value);
  }

  numbers() {
    const rows = this.data.columns.map((column) => {
      const row = element("tr", { title: column.title });
      const unit = column.unit ? ` (${column.unit})` : "";
      row.dataset.name = column.name;
      row.append(element("td", { textContent: column.name + unit }),
        element("td", { className: "number", textContent: this.text(column) }));
      return row;
    });
    return element("div", { className: "numbers" }, element("table", {}, element("tbody", {}, ...rows)));
  }

  commandText() {
    const place = (part) => (part.axis === undefined ? this.flat() : this.chosen[part.axis]);
    return this.data.command.map((part) => (part.values ? written(part.values[place(part)]) : part)).join("");
  }

  command() {
    const line = this.commandText();
    const copy = element("button", { type: "button", textContent: "Copy" });
    copy.addEventListener("click", async () => {
      await navigator.clipboard.writeText(line);
      copy.textContent = "Copied";
    });
    const words = line.split(" ").flatMap((word, place) => [place ? " " : "", element("span", { textContent: word })]);
    return element("div", { className: "command" }, element("code", {}, ...words), copy); // no line ends at a hyphen
  }

  // The motion of the point, or of the nearest that has one.
  async history() {
    const { histories, axes, whole } = this.data;
    if (!histories) return null;
    const places = histories.indexes.map((indexes, axis) => {
      const at = whole[axis][this.chosen[axis]];
      return indexes.reduce((best, index, place) => (Math.abs(index - at) < Math.abs(indexes[best] - at) ? place : best), 0);
    });
    const flat = places.reduce((sum, place, axis) => sum * histories.indexes[axis].length + place, 0);
    const record = histories.records[flat];
    const nearest = places.map((place, axis) => fromJson(histories.axes[axis][place]));
    const isOwn = nearest.every((value, axis) => value === axes[axis].values[this.chosen[axis]]);
    const name = axes.map((axis, place) => `${axis.name} = ${written(nearest[place])}`).join(", ");
    const heading = isOwn ? "Motion" : `Motion of the nearest point that has one: ${name}`;
    if (!record) return element("p", { className: "quiet", textContent: `${heading}: none` });
    record.rows ||= await doubles(record.values);
    const count = record.rows.length / 3;
    const [tau, x, v] = [0, 1, 2].map((part) => record.rows.subarray(part * count, (part + 1) * count));
    return element("div", {}, element("div", { className: "quiet", textContent: heading }),
      chart(tau, x, "τ", "x", record.stops, false), chart(x, v, "x", "x′", record.stops, true));
  }
}

// A line through points in a frame, with the least and greatest numbers of both sides.
const chart = (across, along, acrossName, alongName, stops, stopsAcross) => {
  const [width, height, left, bottom] = [420, 150, 46, 18];
  const range = (values, more) => [Math.min(...values, ...more), Math.max(...values, ...more)];
  const [x0, x1] = range(across, stopsAcross ? stops : []), [y0, y1] = range(along, stopsAcross ? [] : stops);
  const px = (x) => left + ((x - x0) / (x1 - x0 || 1)) * (width - left - 4);
  const py = (y) => height - bottom - ((y - y0) / (y1 - y0 || 1)) * (height - bottom - 6);
  const svg = drawn("svg", { viewBox: `0 0 ${width} ${height}`, class: "history", role: "img" });
  svg.setAttribute("aria-label", `${alongName} over ${acrossName}`);
  const line = (kind, a, b, c, d) => svg.append(drawn("line", { class: kind, x1: a, y1: b, x2: c, y2: d }));
  svg.append(drawn("rect", { class: "frame", x: left, y: 6, width: width - left - 4, height: height - bottom - 6 }));
  for (const stop of stops)
    stopsAcross ? line("stop", px(stop), 6, px(stop), height - bottom) : line("stop", left, py(stop), width - 4, py(stop));
  const points = Array.from(across, (x, i) => `${px(x).toFixed(2)},${py(along[i]).toFixed(2)}`).join(" ");
  svg.append(drawn("polyline", { class: "motion", points }));
  const label = (text, x, y, anchor) => {
    const made = drawn("text", { x, y, "text-anchor": anchor });
    made.textContent = text;
    svg.append(made);
  };
  const short = (value) => String(Number(value.toPrecision(4))).replace("-", "−");
  label(short(y1), left - 4, 14, "end");
  label(short(y0), left - 4, height - bottom, "end");
  label(alongName, left - 4, (height - bottom) / 2 + 6, "end");
  label(short(x0), left, height - 5, "start");
  label(short(x1), width - 4, height - 5, "end");
  label(acrossName, (left + width) / 2, height - 5, "middle");
  return svg;
};

const explorers = [...document.querySelectorAll("section.file")].map(
  (section) => new Explorer(section, JSON.parse(section.querySelector("script").textContent)));
window.ready = Promise.all(explorers.map((explorer) => explorer.begin()));

const theme = document.getElementById("theme");
theme.hidden = false;
theme.addEventListener("click", () => {
  const root = document.documentElement;
  const isDark = root.dataset.theme ? root.dataset.theme === "dark" : matchMedia("(prefers-color-scheme: dark)").matches;
  root.dataset.theme = isDark ? "light" : "dark";
});
