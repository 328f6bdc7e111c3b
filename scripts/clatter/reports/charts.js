"use strict";
// Charts of the motion of a point, as SVG.

const svgNames = "http://www.w3.org/2000/svg";

const drawn = (name, attributes) => {
  const made = document.createElementNS(svgNames, name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  return made;
};

// How wide a text of a chart is, in its units.
const pencil = document.createElement("canvas").getContext("2d");
const lengthOf = (text) => {
  pencil.font = `10px ${getComputedStyle(document.body).fontFamily}`;
  return pencil.measureText(text).width;
};

// Lines through points in a frame, with the least and greatest numbers of both sides; null if no point has a number, as
// of a loose mass without mass.
const chart = (across, lines, names, stops, stopsAcross) => {
  lines = lines.map((line) => Array.from(across, (x, i) => [x, line[i]]).filter(([x, y]) => Number.isFinite(x) && Number.isFinite(y)));
  lines = lines.filter((line) => line.length);
  if (!lines.length) return null;
  const short = (value) => String(Number(value.toPrecision(4))).replace("-", "−");
  const range = (side, more) => lines.flat().map((point) => point[side]).concat(more).reduce(([low, high], value) => [Math.min(low, value), Math.max(high, value)], [Infinity, -Infinity]);
  const [x0, x1] = range(0, stopsAcross ? stops : []);
  const [y0, y1] = range(1, stopsAcross ? [] : stops);
  const [width, height, top, bottom, right, name] = [420, 162, 6, 34, 8, 15];
  const left = Math.ceil(name + 6 + Math.max(lengthOf(short(y0)), lengthOf(short(y1))));
  const px = (x) => left + ((x - x0) / (x1 - x0 || 1)) * (width - left - right);
  const py = (y) => height - bottom - ((y - y0) / (y1 - y0 || 1)) * (height - bottom - top);
  const svg = drawn("svg", { viewBox: `0 0 ${width} ${height}`, class: "history", role: "img" });
  svg.setAttribute("aria-label", `${names[1]} over ${names[0]}`);
  const line = (kind, a, b, c, d) => svg.append(drawn("line", { class: kind, x1: a, y1: b, x2: c, y2: d }));
  svg.append(drawn("rect", { class: "frame", x: left, y: top, width: width - left - right, height: height - bottom - top }));
  for (const stop of stops)
    stopsAcross ? line("stop", px(stop), top, px(stop), height - bottom) : line("stop", left, py(stop), width - right, py(stop));
  lines.forEach((line, number) => {
    const points = line.map(([x, y]) => `${px(x).toFixed(2)},${py(y).toFixed(2)}`).join(" ");
    svg.append(drawn("polyline", { class: number ? "motion second" : "motion", points }));
  });
  const label = (text, x, y, anchor, more = {}) => {
    const made = drawn("text", { x, y, "text-anchor": anchor, ...more });
    made.textContent = text;
    svg.append(made);
  };
  label(short(y1), left - 4, top + 8, "end");
  label(short(y0), left - 4, height - bottom, "end");
  const middle = (top + height - bottom) / 2;
  label(names[1], 10, middle, "middle", { transform: `rotate(-90 10 ${middle})` });
  label(short(x0), left, height - bottom + 13, "start");
  label(short(x1), width - right, height - bottom + 13, "end");
  label(names[0], (left + width - right) / 2, height - 6, "middle");
  return svg;
};
