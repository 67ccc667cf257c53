// Charts of the station's page, as SVG: points and lines over two axes with units. Nothing from elsewhere.
"use strict";

const PREFIXES = [[1e9, "G"], [1e6, "M"], [1e3, "k"], [1, ""], [1e-3, "m"], [1e-6, "µ"], [1e-9, "n"], [1e-12, "p"], [1e-15, "f"], [1e-18, "a"]];
const MARGIN = {left: 74, right: 14, top: 10, bottom: 44};

/** Factor and prefix with which `value` has one to three digits before the point. */
function prefixFor(value) {
  const size = Math.abs(value) * (1 + 1e-9);
  const found = size > 0 ? PREFIXES.find(([factor]) => size >= factor) : [1, ""];
  return found || PREFIXES[PREFIXES.length - 1];
}

function element(name, attributes, text) {
  const made = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  if (text !== undefined) made.textContent = text;
  return made;
}

/** Round steps for about `count` ticks between low and high. */
function ticksOf(low, high, count) {
  const rough = (high - low) / Math.max(1, count);
  const decade = Math.pow(10, Math.floor(Math.log10(rough)));
  const step = [1, 2, 5, 10].map((digit) => digit * decade).find((one) => one >= rough * 0.999);
  const ticks = [];
  for (let place = Math.ceil(low / step - 1e-9); place * step <= high * (1 + 1e-9) + step * 1e-9; ++place) ticks.push(place * step);
  return ticks;
}

/** 1, 2, 5 of the decades where `count` ticks have room for them, else 1 alone, or of every so many decades. */
function logTicksOf(low, high, count) {
  const decades = Math.log10(high / low);
  const digits = 3 * decades > count ? [1] : [1, 2, 5];
  const every = Math.ceil(decades / count);
  const ticks = [];
  for (let exponent = Math.floor(Math.log10(low)); exponent <= Math.log10(high); exponent += 1) {
    if (exponent % every) continue;
    for (const digit of digits) ticks.push(digit * Math.pow(10, exponent));
  }
  return ticks.filter((tick) => tick >= low && tick <= high);
}

function shortNumber(value) {
  return String(Number(value.toPrecision(6)));
}

/** Limits of an axis: from 0 where nothing is below, logarithmic where positive values span more than a factor of thirty. */
function limitsOf(values, mayBeLogarithmic) {
  const finite = values.filter((value) => value !== null && Number.isFinite(value));
  if (!finite.length) return {low: 0, high: 1, log: false};
  const low = Math.min(...finite);
  const high = Math.max(...finite);
  if (mayBeLogarithmic && low > 0 && high > 30 * low) return {low: low / 1.5, high: high * 1.5, log: true};
  const top = high > 0 ? high * 1.2 : 0;
  const bottom = low < 0 ? low * 1.12 : 0;
  return top > bottom ? {low: bottom, high: top, log: false} : {low: 0, high: 1, log: false};
}

/**
 * Draws into an svg element. chart: {x: {label, unit, low, high, whole}, y: {label, unit, low, high, log},
 * lines: [{points: [[x, y]], colour, width, dash}], whiskers: [[x, low, high]], marks: [{x, y, colour, shape}],
 * rings: [{x, y, colour}], bands: [x], levels: [{y, colour}], texts: [{x, y, text}]}. A point whose y is null breaks a line.
 */
function drawChart(svg, chart) {
  const width = svg.clientWidth;
  const height = svg.clientHeight;
  svg.replaceChildren();
  if (!width || !height) return;
  svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
  const place = placesOf(chart, width, height);
  drawBands(svg, chart, place);
  drawAxes(svg, chart, place);
  const inside = clipped(svg, place);
  for (const level of chart.levels || []) {
    const y = place.y(level.y);
    inside.append(element("line", {x1: place.left, x2: place.right, y1: y, y2: y, stroke: level.colour, "stroke-width": 2, "stroke-dasharray": "8 5"}));
  }
  for (const [x, low, high] of chart.whiskers || []) {
    if (low === null || high === null) continue;
    inside.append(element("line", {x1: place.x(x), x2: place.x(x), y1: place.y(low), y2: place.y(high), stroke: "#a8adb8", "stroke-width": 3, opacity: 0.8}));
  }
  for (const line of chart.lines || []) {
    inside.append(element("path", {d: pathOf(line.points, place), fill: "none", stroke: line.colour, "stroke-width": line.width || 2,
                                "stroke-dasharray": line.dash || "none", "stroke-linejoin": "round"}));
  }
  for (const mark of chart.marks || []) {
    if (mark.y === null) continue;
    inside.append(element("circle", {cx: place.x(mark.x), cy: place.y(mark.y), r: mark.radius || 5, fill: mark.colour}));
  }
  for (const ring of chart.rings || []) {
    inside.append(element("ellipse", {cx: place.x(ring.x), cy: place.y(ring.y), rx: 10, ry: 10, fill: "none", stroke: ring.colour, "stroke-width": 2.5}));
  }
  for (const note of chart.texts || []) {
    const x = place.x(note.x);
    const anchor = x > 0.6 * place.right ? "end" : "start";
    svg.append(element("text", {x: x + (anchor === "end" ? -10 : 10), y: Math.max(place.top + 6, place.y(note.y) - 9), "text-anchor": anchor}, note.text));
  }
}

/** A group whose content does not leave the axes by more than a mark. */
function clipped(svg, place) {
  const clip = element("clipPath", {id: `${svg.id}-inside`});
  clip.append(element("rect", {x: place.left - 8, y: place.top - 8, width: place.right - place.left + 16, height: place.bottom - place.top + 16}));
  const group = element("g", {"clip-path": `url(#${svg.id}-inside)`});
  svg.append(clip, group);
  return group;
}

function placesOf(chart, width, height) {
  const place = {left: MARGIN.left, right: width - MARGIN.right, top: MARGIN.top, bottom: height - MARGIN.bottom};
  const toY = chart.y.log ? Math.log : (value) => value;
  const inside = (value) => Math.min(Math.max(value, -1e4), 1e4);
  place.x = (value) => place.left + (value - chart.x.low) / (chart.x.high - chart.x.low) * (place.right - place.left);
  place.y = (value) => inside(place.bottom - (toY(Math.max(value, chart.y.log ? chart.y.low * 1e-3 : value)) - toY(chart.y.low)) /
                              (toY(chart.y.high) - toY(chart.y.low)) * (place.bottom - place.top));
  return place;
}

function pathOf(points, place) {
  let path = "";
  let isOpen = false;
  for (const [x, y] of points) {
    if (y === null) { isOpen = false; continue; }
    path += `${isOpen ? "L" : "M"}${place.x(x).toFixed(1)} ${place.y(y).toFixed(1)}`;
    isOpen = true;
  }
  return path;
}

function drawBands(svg, chart, place) {
  for (const x of chart.bands || []) {
    const left = Math.max(place.left, place.x(x - 0.5));
    svg.append(element("rect", {x: left, y: place.top, width: Math.max(1, place.x(x + 0.5) - left), height: place.bottom - place.top, fill: "#ffffff", opacity: 0.16}));
  }
}

/** Along an upright axis: smaller and nearer to the middle of the chart where it would leave it. */
function fitInto(label, height, middle) {
  const length = label.getComputedTextLength();
  const scale = Math.min(1, (height - 4) / length);
  if (scale < 1) label.style.fontSize = `${15 * scale}px`;
  const half = 0.5 * scale * length + 2;
  const y = Math.min(Math.max(middle, half), Math.max(half, height - half));
  label.setAttribute("y", y);
  label.setAttribute("transform", `rotate(-90 16 ${y})`);
}

function drawAxes(svg, chart, place) {
  const largest = (axis) => Math.max(Math.abs(axis.low), Math.abs(axis.high));
  const [xFactor, xPrefix] = chart.x.unit ? prefixFor(largest(chart.x)) : [1, ""];
  const [yFactor, yPrefix] = chart.y.unit ? prefixFor(largest(chart.y)) : [1, ""];
  let xTicks = ticksOf(chart.x.low, chart.x.high, (place.right - place.left) / 90);
  if (chart.x.whole) xTicks = xTicks.filter(Number.isInteger);
  const yTicks = chart.y.log ? logTicksOf(chart.y.low, chart.y.high, (place.bottom - place.top) / 24) : ticksOf(chart.y.low, chart.y.high, (place.bottom - place.top) / 42);
  // Over more than three decades each tick has its own prefix, since one for all would need 0.000001 of it.
  const hasOwnPrefixes = Boolean(chart.y.log && chart.y.unit && chart.y.high > 1e3 * chart.y.low);
  const yText = (tick) => {
    if (!hasOwnPrefixes) return shortNumber(tick / yFactor);
    const [factor, prefix] = prefixFor(tick);
    return `${shortNumber(tick / factor)} ${prefix}`;
  };
  for (const tick of yTicks) {
    const y = place.y(tick);
    svg.append(element("line", {x1: place.left, x2: place.right, y1: y, y2: y, stroke: Math.abs(tick) < 1e-30 ? "#a8adb8" : "#3a3f4a"}));
    svg.append(element("text", {x: place.left - 8, y: y + 5, "text-anchor": "end"}, yText(tick)));
  }
  for (const tick of xTicks) {
    const x = place.x(tick);
    svg.append(element("line", {x1: x, x2: x, y1: place.top, y2: place.bottom, stroke: "#3a3f4a"}));
    svg.append(element("text", {x: x, y: place.bottom + 18, "text-anchor": "middle"}, shortNumber(tick / xFactor)));
  }
  const unit = (axis, prefix) => axis.unit ? ` [${prefix}${axis.unit}]` : "";
  svg.append(element("text", {class: "label", x: (place.left + place.right) / 2, y: place.bottom + 38, "text-anchor": "middle"}, chart.x.label && chart.x.label + unit(chart.x, xPrefix)));
  const middle = (place.top + place.bottom) / 2;
  const label = element("text", {class: "label", x: 16, y: middle, "text-anchor": "middle", transform: `rotate(-90 16 ${middle})`}, chart.y.label + unit(chart.y, hasOwnPrefixes ? "" : yPrefix));
  svg.append(label);
  fitInto(label, svg.clientHeight, middle);
}
