"use strict";
// Shows the numbers of a point, its motion and its command when a place of the picture is chosen.

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
    this.inputs = data.axes.flatMap((axis, place) => [axis, ...axis.linked].map((input) => Object.assign(input, { place })));
    for (const input of this.inputs) input.values = await doubles(input.values);
    for (const part of data.command) if (part.values) part.values = await doubles(part.values);
    for (const column of data.columns) column.values = await doubles(column.values);
    this.byName = Object.fromEntries(data.columns.map((column) => [column.name, column]));
    for (const panel of data.panels)
      for (const [place, result] of (panel.results || []).entries())
        panel.results[place] = result.values ? await doubles(result.values) : this.byName[result].values;
    for (const part of ["nearest", "other"])
      if (data.histories) data.histories[part] = await doubles(data.histories[part]);
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
    } else if (panel.plane || panel.cloud) {
      this.chosen[(panel.axes || [0])[0]] = this.nearestDot(panel, at, image);
    } else {
      panel.axes.forEach((axis, side) => (this.chosen[axis] = this.nearestValue(panel, side, axis, at[side])));
      if (panel.results) this.chosen = this.nearestCurve(panel, at[1]);
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

  // Places of the chosen point, with the axes that have a curve for each of their values at any of these, and those
  // that the picture holds at their first.
  *curvesOf(panel) {
    const held = this.chosen.map((place, axis) => (panel.axes.includes(axis) ? place : 0));
    const sizes = panel.families.map((axis) => this.data.shape[axis]);
    for (let number = sizes.reduce((all, size) => all * size, 1) - 1; number >= 0; number--) {
      let rest = number;
      panel.families.forEach((axis, place) => ([held[axis], rest] = [rest % sizes[place], Math.floor(rest / sizes[place])]));
      yield [...held];
    }
  }

  nearestCurve(panel, at) {
    let best = this.chosen, least = Infinity;
    for (const index of this.curvesOf(panel))
      for (const values of panel.results) {
        const away = Math.abs(share(panel, 1, values[this.flat(index)]) - at);
        if (away < least) [best, least] = [index, away];
      }
    return best;
  }

  // The numbers across and along of the dots of a panel.
  dotsIn(panel) {
    if (panel.plane) return [panel.plane.map((name) => this.inputs.find((input) => input.name === name).values)];
    return panel.results.map((values) => [this.data.axes[panel.axes[0]].values, values]);
  }

  nearestDot(panel, at, image) {
    const found = this.dotsIn(panel).map(([across, along]) => this.nearestOf(panel, across, along, at, image));
    return found.reduce((best, one) => (one[1] < best[1] ? one : best))[0];
  }

  nearestPoint(panel, at, image) {
    return this.nearestOf(panel, ...panel.columns.map((name) => this.byName[name].values), at, image)[0];
  }

  nearestOf(panel, across, along, at, image) {
    const width = (panel.box[2] - panel.box[0]) * image.width, height = (panel.box[3] - panel.box[1]) * image.height;
    let best = 0, least = Infinity;
    across.forEach((value, place) => {
      const away = Math.hypot((share(panel, 0, value) - at[0]) * width, (share(panel, 1, along[place]) - at[1]) * height);
      if (away < least) [best, least] = [place, away];
    });
    return [best, least];
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
    const button = document.activeElement?.closest(".point button")?.getAttribute("aria-label");
    const parts = [this.steps(), this.numbers()];
    parts.push(this.command(), await this.history());
    this.side.replaceChildren(...parts.filter(Boolean));
    if (button) [...this.side.querySelectorAll("button")].find((one) => one.getAttribute("aria-label") === button)?.focus();
    this.section.querySelector(".told").textContent = this.place();
  }

  // Where the chosen point lies, in a sentence that a screen reader says; the numbers are read on demand.
  place() {
    if (!this.data.axes.length) return this.data.shape.length ? `point ${this.chosen[0] + 1} of ${this.data.shape[0]}` : "";
    return this.inputs.map((input) => `${input.name} = ${written(input.values[this.chosen[input.place]])}`).join(", ");
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
      const [left, top, right, bottom] = panel.box;
      const at = (side, value) => (side ? bottom - share(panel, 1, value) * (bottom - top) : left + share(panel, 0, value) * (right - left));
      const isIn = (value, low, high) => value >= low - 1e-6 && value <= high + 1e-6;
      const [across, along] = this.markedIn(panel);
      const x = at(0, across);
      if (!isIn(x, left, right)) continue;
      const heights = along.map((value) => at(1, value)).filter((y) => isIn(y, top, bottom));
      if (!heights.length && !panel.results && along.length) continue;
      add("across", x, top, 0, bottom - top);
      if (!panel.results) heights.forEach((y) => add("along", left, y, right - left, 0));
      heights.forEach((y) => add("dot", x, y, 0, 0));
    }
  }

  // The number across that a panel has of the chosen point, and those along.
  markedIn(panel) {
    if (panel.columns) return ((at) => [at[0], [at[1]]])(panel.columns.map((name) => this.byName[name].values[this.chosen[0]]));
    if (panel.plane) return ((at) => [at[0], [at[1]]])(this.dotsIn(panel)[0].map((values) => values[this.chosen[0]]));
    const [across, ...along] = panel.axes.map((axis) => this.data.axes[axis].values[this.chosen[axis]]);
    const isDrawn = panel.results && [...this.curvesOf(panel)].some((index) => this.flat(index) === this.flat());
    return [across, isDrawn ? panel.results.map((values) => values[this.flat()]) : along];
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
      for (const linked of axis.linked || [])
        box.append(element("span", { className: "linked" }, element("b", { textContent: linked.name }), ` ${linked.title}`),
          element("span", { className: "value", textContent: written(linked.values[this.chosen[place]]) }));
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
      const over = column.over ? ` ${column.over}` : "";
      const unit = column.unit ? ` (${column.unit})` : "";
      row.dataset.name = column.name;
      row.append(element("td", { textContent: column.name + over + unit }),
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

  // The motion of the point, or of the nearest that has one: by the values of all inputs, and of the same motion if any is.
  async history() {
    const { histories, axes, whole } = this.data;
    if (!histories) return null;
    const record = histories.records[histories.nearest[this.flat()]];
    let rest = histories.nearest[this.flat()];
    const places = histories.indexes.map((indexes) => indexes.length).reduceRight((found, size) => {
      found.unshift(rest % size);
      rest = Math.floor(rest / size);
      return found;
    }, []);
    const isOwn = places.every((place, axis) => histories.indexes[axis][place] === whole[axis][this.chosen[axis]]);
    const name = axes.map((axis, i) => `${axis.name} = ${written(fromJson(histories.axes[i][places[i]]))}`).join(", ");
    const kind = histories.other[this.flat()] ? "Another motion, since none of this one is known" : "Motion of the nearest point that has one";
    const heading = isOwn ? "Motion" : `${kind}: ${name}`;
    if (!record) return element("p", { className: "quiet", textContent: `${heading}: none` });
    record.numbers ||= await doubles(record.values);
    const width = 1 + Math.max(...histories.charts.flatMap(({ rows }) => rows).flat());
    const count = record.numbers.length / width;
    const row = (number, scale) => record.numbers.subarray(number * count, (number + 1) * count).map((value) => value * scale);
    const drawings = histories.charts.map(({ rows: [across, along], names, scales, stops }) =>
      chart(row(across, scales[0]), along.map((number) => row(number, scales[1])), names,
        stops ? record.stops.map((stop) => stop * scales[stops === "across" ? 0 : 1]) : [], stops === "across"));
    return element("div", {}, element("div", { className: "quiet", textContent: heading }), ...drawings.filter(Boolean));
  }
}

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
