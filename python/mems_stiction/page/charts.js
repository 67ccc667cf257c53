// Charts of the station's page, as SVG: points and lines over two axes with units. Nothing from elsewhere.
"use strict";

const PREFIXES = [[1e9, "G"], [1e6, "M"], [1e3, "k"], [1, ""], [1e-3, "m"], [1e-6, "µ"], [1e-9, "n"], [1e-12, "p"], [1e-15, "f"], [1e-18, "a"]];
const LARGEST = 1e30;     // of a number that is drawn
const MOST_TICKS = 100;
const MARGIN = {left: 74, right: 14, top: 10, bottom: 44};
const zooms = {};  // of the charts that show a piece of their x axis: [low, high] by the id of the svg

/** Factor and prefix with which `value` has one to three digits before the point. */
function prefixFor(value) {
  const size = Math.abs(value) * (1 + 1e-9);
  const found = size > 0 ? PREFIXES.find(([factor]) => size >= factor) : [1, ""];
  return found || PREFIXES[PREFIXES.length - 1];
}

/** A value in three digits, with the unit of a figure or an axis where it has one. */
function ofFigure(value, figure) {
  const [factor, prefix] = figure.unit ? prefixFor(value) : [1, ""];
  return `${Number((value / factor).toPrecision(3))}${figure.unit ? ` ${prefix}${figure.unit}` : ""}`;
}

function element(name, attributes, text) {
  const made = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  if (text !== undefined) made.textContent = text;
  return made;
}

/** Whether an axis can reach from low to high. */
const isDrawable = (low, high) => Math.abs(low) <= LARGEST && Math.abs(high) <= LARGEST && low < high;

/** Round steps for about `count` ticks between low and high. */
function ticksOf(low, high, count) {
  const rough = (high - low) / Math.max(1, count);
  const decade = Math.pow(10, Math.floor(Math.log10(rough)));
  const step = [1, 2, 5, 10].map((digit) => digit * decade).find((one) => one >= rough * 0.999);
  const ticks = [];
  if (!isDrawable(low, high) || !(step > 0)) return ticks;
  for (let place = Math.ceil(low / step - 1e-9); ticks.length < MOST_TICKS && place * step <= high * (1 + 1e-9) + step * 1e-9; ++place) ticks.push(place * step);
  return ticks;
}

/** 1, 2, 5 of the decades where `count` ticks have room for them, else 1 alone, or of every so many decades. */
function logTicksOf(low, high, count) {
  if (!isDrawable(low, high) || !(low > 0)) return [];
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
  const finite = values.filter((value) => value !== null && Math.abs(value) < LARGEST / 2);
  if (!finite.length) return {low: 0, high: 1, log: false};
  const low = finite.reduce((least, value) => Math.min(least, value));
  const high = finite.reduce((most, value) => Math.max(most, value));
  if (mayBeLogarithmic && low > 0 && high > 30 * low) return {low: low / 1.5, high: high * 1.5, log: true};
  const top = high > 0 ? high * 1.2 : 0;
  const bottom = low < 0 ? low * 1.12 : 0;
  return top > bottom ? {low: bottom, high: top, log: false} : {low: 0, high: 1, log: false};
}

/**
 * Draws into an svg element. chart: {x: {label, unit, low, high, whole}, y: {label, unit, low, high, log},
 * areas: [{points: [[x, low, high]], colour}], whiskers: [[x, low, high]], marks: [{x, y, colour, radius}], rings: [{x, y, colour}], bands: [x],
 * levels: [{y, colour}], uprights: [{x, colour, dash}], numbers: [{x, y, text, isNumber: true}], texts: [{x, y, text}]}. A point whose y is null breaks a line.
 */
function drawChart(svg, whole) {
  const width = svg.clientWidth;
  const height = svg.clientHeight;
  svg.replaceChildren();
  if (!width || !height) return;
  svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
  const chart = zoomedChart(svg, whole);
  svg.setAttribute("role", "img");
  svg.setAttribute("aria-label", wordsOf(chart));
  const place = placesOf(chart, width, height);
  followZoom(svg, chart, place);
  drawBands(svg, chart, place);
  drawAxes(svg, chart, place);
  const inside = clipped(svg, place);
  for (const area of chart.areas || []) {
    const known = area.points.filter(([, low, high]) => low !== null && high !== null);
    const outline = known.map(([x, low]) => [x, low]).concat(known.map(([x, , high]) => [x, high]).reverse());
    inside.append(element("path", {d: pathOf(outline, place), fill: area.colour, "fill-opacity": 0.2, class: "area"}));
  }
  for (const upright of chart.uprights || []) {
    const x = place.x(upright.x);
    inside.append(element("line", {x1: x, x2: x, y1: place.top, y2: place.bottom, stroke: upright.colour, "stroke-width": 2.5, "stroke-dasharray": upright.dash, class: "upright"}));
  }
  for (const level of chart.levels || []) {
    const y = place.y(level.y);
    inside.append(element("line", {x1: place.left, x2: place.right, y1: y, y2: y, stroke: level.colour, "stroke-width": 2, "stroke-dasharray": "8 5"}));
  }
  for (const [x, low, high] of chart.whiskers || []) {
    if (low === null || high === null) continue;
    inside.append(element("line", {x1: place.x(x), x2: place.x(x), y1: place.y(low), y2: place.y(high), stroke: "var(--quiet)", "stroke-width": 3, opacity: 0.8}));
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
  const taken = [];  // by texts: boxes [left, top, right, bottom]
  const drawn = drawnPoints(chart, place);
  for (const note of (chart.numbers || []).concat(chart.texts || [])) {
    if (place.x(note.x) < place.left - 1 || place.x(note.x) > place.right + 1) continue;
    const text = element("text", note.isNumber ? {class: "number"} : {}, note.text);
    svg.append(text);
    putBeside(text, [place.x(note.x), place.y(note.y)], place, drawn, taken);
  }
}

/** What a screen reader says of a chart: its axes, and where they end. */
function wordsOf({x, y}) {
  const words = (axis) => `${axis.label || "the same axis"} from ${ofFigure(axis.low, axis)} to ${ofFigure(axis.high, axis)}`;
  return `Chart: ${words(y)} over ${words(x)}`;
}

/** Points in pixels along all that is drawn, so that texts can keep off it. */
function drawnPoints(chart, place) {
  const points = (chart.marks || []).filter((mark) => mark.y !== null).map((mark) => [place.x(mark.x), place.y(mark.y)]);
  for (const {points: line} of chart.lines || []) {
    for (let index = 0; index + 1 < line.length; ++index) {
      const [[x0, y0], [x1, y1]] = [line[index], line[index + 1]];
      if (y0 === null || y1 === null) continue;
      const [from, to] = [[place.x(x0), place.y(y0)], [place.x(x1), place.y(y1)]];
      const steps = Math.min(200, Math.ceil(Math.hypot(to[0] - from[0], to[1] - from[1]) / 4));
      for (let step = 0; step <= steps; ++step) points.push([0, 1].map((axis) => from[axis] + (to[axis] - from[axis]) * step / Math.max(1, steps)));
    }
  }
  for (const {y} of chart.levels || []) for (let x = place.left; x < place.right; x += 4) points.push([x, place.y(y)]);
  return points;
}

/** Puts a text beside its point, inside the axes, where it hides least of what is drawn and no other text. */
function putBeside(text, [x, y], place, drawn, taken) {
  const {width, height} = text.getBBox();
  const boxAt = ([dx, dy]) => {
    const left = Math.min(Math.max(x + dx - width / 2, place.left + 2), place.right - width - 2);
    const top = Math.min(Math.max(y + dy - height / 2, place.top + 1), place.bottom - height - 1);
    return [left, top, left + width, top + height];
  };
  const hidden = ([left, top, right, bottom]) =>
    drawn.filter(([px, py]) => px > left - 2 && px < right + 2 && py > top - 1 && py < bottom + 1).length +
    1000 * taken.filter((box) => box[0] < right + 2 && box[2] > left - 2 && box[1] < bottom && box[3] > top).length;
  const [side, over] = [width / 2 + 12, height / 2 + 7];
  const places = [1, 2, 3, 4].flatMap((far) => [[0, -over * far], [side, -over * far], [-side, -over * far], [side * far, 0], [-side * far, 0], [0, over * far],
                                               [side, over * far], [-side, over * far]]).map(boxAt);
  const best = places.reduce((found, box) => hidden(box) < hidden(found) ? box : found);
  taken.push(best);
  text.setAttribute("x", best[0]);
  text.setAttribute("y", best[1] + 0.8 * height);
}

// ---------------------------------------------------------------- zoom

/** The chart over the piece of its x axis that was dragged; the whole where nothing was. */
function zoomedChart(svg, chart) {
  const range = zooms[svg.id];
  if (!range) return chart;
  const x = Object.assign({}, chart.x, {low: Math.max(range[0], chart.x.low), high: Math.min(range[1], chart.x.high)});
  if (!(x.high > x.low)) { delete zooms[svg.id]; return chart; }
  const seen = (chart.lines || []).flatMap((line) => line.points).concat((chart.marks || []).map((mark) => [mark.x, mark.y]))
    .concat((chart.whiskers || []).flatMap(([at, low, high]) => [[at, low], [at, high]])).filter(([at]) => at >= x.low && at <= x.high).map(([, y]) => y)
    .concat((chart.levels || []).map((level) => level.y));
  const y = seen.some((value) => value !== null) ? Object.assign({}, chart.y, limitsOf(seen, Boolean(chart.y.log))) : chart.y;
  return Object.assign({}, chart, {x, y});
}

/** A drag along the x axis shows that piece of it, a double click the whole. */
function followZoom(svg, chart, place) {
  svg.zoomPlace = {chart, place};
  if (svg.followsZoom) return;
  svg.followsZoom = true;
  let from = null;
  const at = (event) => Math.min(Math.max(event.clientX - svg.getBoundingClientRect().left, svg.zoomPlace.place.left), svg.zoomPlace.place.right);
  const valueAt = (x) => {
    const {chart: shown, place: where} = svg.zoomPlace;
    return shown.x.low + (x - where.left) / (where.right - where.left) * (shown.x.high - shown.x.low);
  };
  svg.addEventListener("pointerdown", (event) => { from = at(event); svg.setPointerCapture(event.pointerId); });
  svg.addEventListener("pointermove", (event) => {
    if (from === null) return;
    for (const old of svg.querySelectorAll(".drag")) old.remove();
    const {top, bottom} = svg.zoomPlace.place;
    svg.append(element("rect", {class: "drag", x: Math.min(from, at(event)), width: Math.abs(at(event) - from), y: top, height: bottom - top}));
  });
  svg.addEventListener("pointerup", (event) => {
    if (from === null) return;
    const ends = [from, at(event)].sort((a, b) => a - b);
    from = null;
    if (ends[1] - ends[0] > 8) zooms[svg.id] = ends.map(valueAt);
    show();
  });
  svg.addEventListener("pointercancel", () => { from = null; });
  svg.addEventListener("dblclick", () => { delete zooms[svg.id]; show(); });
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
  const inside = (value) => Number.isNaN(value) ? -1e4 : Math.min(Math.max(value, -1e4), 1e4);
  place.x = (value) => inside(place.left + (value - chart.x.low) / (chart.x.high - chart.x.low) * (place.right - place.left));
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
    svg.append(element("rect", {x: left, y: place.top, width: Math.max(1, place.x(x + 0.5) - left), height: place.bottom - place.top, fill: "var(--text)", opacity: 0.16}));
  }
}

/** Where the middle of an axis' label is: smaller and nearer to the middle of the chart where it would leave it. */
function placeAlong(label, room, middle) {
  const length = label.getComputedTextLength();
  const scale = Math.min(1, (room - 4) / length);
  if (scale < 1) label.style.fontSize = `${15 * scale}px`;
  const half = 0.5 * scale * length + 2;
  return Math.min(Math.max(middle, half), Math.max(half, room - half));
}

function fitInto(label, height, middle) {
  const y = placeAlong(label, height, middle);
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
    svg.append(element("line", {x1: place.left, x2: place.right, y1: y, y2: y, stroke: Math.abs(tick) < 1e-30 ? "var(--quiet)" : "var(--grid)"}));
    svg.append(element("text", {x: place.left - 8, y: y + 5, "text-anchor": "end"}, yText(tick)));
  }
  for (const tick of xTicks) {
    const x = place.x(tick);
    svg.append(element("line", {x1: x, x2: x, y1: place.top, y2: place.bottom, stroke: "var(--grid)"}));
    const label = element("text", {x: x, y: place.bottom + 18, "text-anchor": "middle"}, shortNumber(tick / xFactor));
    svg.append(label);
    const half = label.getComputedTextLength() / 2;
    label.setAttribute("x", Math.min(x, svg.clientWidth - half - 1));
  }
  const unit = (axis, prefix) => axis.unit ? ` [${prefix}${axis.unit}]` : "";
  const below = element("text", {class: "label", x: (place.left + place.right) / 2, y: place.bottom + 38, "text-anchor": "middle"}, chart.x.label && chart.x.label + unit(chart.x, xPrefix));
  svg.append(below);
  below.setAttribute("x", placeAlong(below, svg.clientWidth, (place.left + place.right) / 2));
  const middle = (place.top + place.bottom) / 2;
  const label = element("text", {class: "label", x: 16, y: middle, "text-anchor": "middle", transform: `rotate(-90 16 ${middle})`}, chart.y.label + unit(chart.y, hasOwnPrefixes ? "" : yPrefix));
  svg.append(label);
  fitInto(label, svg.clientHeight, middle);
}
