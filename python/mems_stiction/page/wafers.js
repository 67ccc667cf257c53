// Maps of the wafers, and their parts side by side: the newest prediction of each place. Asked for when they are looked at and have changed.
"use strict";

const SITE_SHARE = 0.84;  // of the distance between two sites that a mark takes
const MOST_SITE = 24;     // a mark's side [px]
const MAP_EDGE = 18;      // around the sites of a map [px]
const ASK_AGAIN = 1000;   // [ms]
let wafers = null;        // as /wafers tells
let wafersAsked = 0;      // when [ms]
let isAsking = false;
let waferFigure = null;   // its name
let drawnWafers = null;   // what they were drawn by
let chosenPlace = null;   // [number of the wafer's name, x, y]

function showWafers() {
  if (!isAsking && (!wafers || wafers.version !== state.wafers) && (!wafersAsked || performance.now() - wafersAsked > ASK_AGAIN)) askForWafers();
  if (wafers) drawWafers();
}

async function askForWafers() {
  isAsking = true;
  wafersAsked = performance.now();
  try {
    const answer = await fetch("wafers");
    if (answer.ok) wafers = await answer.json();
    else fillList("wafer-notes", [answer.status === 501 ? "Not to be had: the compiled part of the Python module is missing (MEMS_STICTION_WITH_PYTHON)."
      : "The maps cannot be drawn: station_page has said why."]);
  } catch (error) { /* the line at the top says that the server is gone */ } finally { isAsking = false; }
  if (wafers && chosenTab() === "wafers") drawWafers();
}

function drawWafers() {
  const figure = wafers.figures.find((one) => one.name === waferFigure) || wafers.figures[0];
  const looks = JSON.stringify([wafers.version, figure, chosenPlace, window.innerWidth, window.innerHeight, state.parts.map((part) => [part.part, part.serial, part.word])]);
  if (looks === drawnWafers) return;  // what is pressed now stays where it is
  drawnWafers = looks;
  fillFigureButtons(figure);
  fillList("wafer-notes", wafers.notes);
  const hasMaps = Boolean(figure) && wafers.wafers.length > 0;
  say("wafers-of", hasMaps ? `by ${figure.label}` : "");
  byId("wafer-bar").classList.toggle("shown", hasMaps);
  byId("wafer-keys").hidden = !hasMaps;
  const cards = hasMaps ? wafers.wafers.map((wafer, number) => cardOf(wafer, number, figure)) : [];
  byId("wafers").replaceChildren(...cards.map(([card]) => card));
  for (const [, draw] of cards) draw();  // once they have a size
  if (hasMaps) drawWaferBar(figure);
  showChosenPlace(figure);
  drawUnits(figure);
}

function fillFigureButtons(figure) {
  const box = byId("wafer-figures");
  if ([...box.children].map((button) => button.dataset.figure).join() !== wafers.figures.map((one) => one.name).join()) {
    box.replaceChildren(...wafers.figures.map((one) => {
      const button = document.createElement("button");
      button.className = "tool";
      button.dataset.figure = one.name;
      button.textContent = one.label;
      button.addEventListener("click", () => { waferFigure = one.name; drawWafers(); });
      return button;
    }));
  }
  for (const button of box.children) {
    const isChosen = button.dataset.figure === figure.name;
    button.classList.toggle("chosen", isChosen);
    button.setAttribute("aria-pressed", String(isChosen));
  }
}

/** 0 at the low end of the colours, 1 at the high one; an infinite value (null with a text) is there, too. */
function shareOf(value, figure) {
  if (value === null) return 1;
  const of = figure.is_by_ratio ? Math.log : (number) => number;
  const share = (of(value) - of(figure.low)) / (of(figure.high) - of(figure.low));
  return Number.isFinite(share) ? Math.min(Math.max(share, 0), 1) : 1;  // colours that span nothing, or too much
}

function colourAt(share) {
  const at = share * (VIRIDIS.length - 1);
  const [low, high] = [Math.floor(at), Math.ceil(at)].map((place) => [1, 3, 5].map((digit) => parseInt(VIRIDIS[place].slice(digit, digit + 2), 16)));
  return `rgb(${low.map((channel, number) => Math.round(channel + (at - Math.floor(at)) * (high[number] - channel))).join(", ")})`;
}

function cardOf(wafer, number, figure) {
  const places = wafers.places.filter((place) => place.wafer === number);
  const known = places.filter((place) => place.texts[figure.name] !== null);
  const missing = places.length - known.length + wafer.missing.length;
  const card = document.createElement("div");
  const [heading, words, svg] = [document.createElement("h3"), document.createElement("p"), element("svg", {class: "wafer-map", role: "img", "aria-label": `map of ${wafer.name} by ${figure.label}`})];
  heading.textContent = wafer.name;
  words.textContent = [`${known.length} place${known.length === 1 ? "" : "s"}`, missing && `${missing} missing`, `${wafer.bad[figure.name].length} bad`].filter(Boolean).join(", ");
  card.append(heading, words, svg, ...wafer.bad[figure.name].slice(0, 4).map((text) => {
    const line = document.createElement("p");
    line.className = "bad";
    line.textContent = text;
    return line;
  }));
  return [card, () => drawWafer(svg, wafer, places, figure)];
}

/** Sites in one scale along x and y, y upwards. */
function drawWafer(svg, wafer, places, figure) {
  const [width, height] = [svg.clientWidth, svg.clientHeight];
  if (!width) return;
  svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
  const sites = places.map((place) => [place.x, place.y]).concat(wafer.missing);
  const [low, high] = [Math.min, Math.max].map((end) => [0, 1].map((axis) => sites.reduce((found, site) => end(found, site[axis]), sites[0][axis])));
  const room = [width - 2 * MAP_EDGE, height - 24 - 2 * MAP_EDGE];
  const scale = Math.min(...[0, 1].map((axis) => room[axis] / Math.max(high[axis] - low[axis], 1e-9)));
  const at = ([x, y]) => [width / 2 + (x - 0.5 * (low[0] + high[0])) * scale, (height - 24) / 2 - (y - 0.5 * (low[1] + high[1])) * scale];
  const side = Math.max(3, Math.min(MOST_SITE, SITE_SHARE * leastStep(sites, low, high) * scale));
  for (const place of places) {
    const [x, y] = at([place.x, place.y]);
    const text = place.texts[figure.name];
    const mark = text === null ? cross(x, y, side)
      : element("rect", {class: "site", x: x - side / 2, y: y - side / 2, width: side, height: side, fill: colourAt(shareOf(place.values[figure.name], figure))});
    mark.append(element("title", {}, `${place.name}: ${text || "no value"}`));
    svg.append(mark);
  }
  for (const site of wafer.missing) svg.append(cross(...at(site), side));
  for (const place of places.filter((one) => one.bad.includes(figure.name))) {
    const [cx, cy] = at([place.x, place.y]);
    svg.append(element("circle", {class: "bad-site", cx, cy, r: 0.8 * side + 2}));
  }
  const chosen = chosenOf(places);
  if (chosen) { const [x, y] = at([chosen.x, chosen.y]); svg.append(element("rect", {class: "chosen-site", x: x - side / 2 - 2, y: y - side / 2 - 2, width: side + 4, height: side + 4})); }
  const extent = [0, 1].map((axis) => high[axis] - low[axis]);
  svg.append(element("text", {class: "label", x: width / 2, y: height - 6, "text-anchor": "middle"}, Math.max(...extent) ? `x to the right, ${lengthText(extent[0])}; y up, ${lengthText(extent[1])}` : "one site"));
  svg.addEventListener("click", (event) => {
    const box = svg.getBoundingClientRect();
    const far = (place) => { const [x, y] = at([place.x, place.y]); return Math.hypot(x - event.clientX + box.left, y - event.clientY + box.top); };
    const nearest = places.reduce((found, place) => far(place) < far(found) ? place : found);
    chosenPlace = far(nearest) < side + 8 ? [wafer.name, nearest.x, nearest.y] : null;
    drawWafers();
  });
}

function cross(x, y, side) {
  const half = Math.max(3, 0.3 * side);
  return element("path", {class: "missing-site", d: `M${x - half} ${y - half}L${x + half} ${y + half}M${x - half} ${y + half}L${x + half} ${y - half}`});
}

/** Between two sites: that of different x or of different y, beyond what is but scatter. */
function leastStep(sites, low, high) {
  const least = Math.max(high[0] - low[0], high[1] - low[1]) / 60;
  const steps = [0, 1].flatMap((axis) => {
    const places = [...new Set(sites.map((site) => site[axis]))].sort((a, b) => a - b);
    return places.slice(1).map((place, number) => place - places[number]).filter((step) => step > least);
  });
  return steps.length ? Math.min(...steps) : 1;
}

const chosenOf = (places) => chosenPlace && places.find((place) => place.wafer !== null && wafers.wafers[place.wafer].name === chosenPlace[0] && place.x === chosenPlace[1] && place.y === chosenPlace[2]);

function showChosenPlace(figure) {
  const place = chosenOf(wafers.places);
  const value = (one) => `${one.label} ${place.texts[one.name] === null ? "missing" : place.texts[one.name]}`;
  say("wafer-place", place ? `${capital(place.name)}: ${wafers.figures.map(value).join(", ")}` : figure && wafers.wafers.length ? "A click on a place tells its values." : "");
}

function drawWaferBar(figure) {
  const bar = byId("wafer-bar");
  const [width, left] = [bar.clientWidth, 8];
  bar.replaceChildren();
  bar.setAttribute("viewBox", `0 0 ${width} 46`);
  const gradient = element("linearGradient", {id: "wafer-colours"});
  VIRIDIS.forEach((colour, place) => gradient.append(element("stop", {offset: place / (VIRIDIS.length - 1), "stop-color": colour})));
  const [factor, prefix] = figure.unit ? prefixFor(figure.high) : [1, ""];
  const unit = element("text", {class: "label", x: width - 2, y: 14, "text-anchor": "end"}, figure.unit ? prefix + figure.unit : "");
  bar.append(gradient, unit);
  const long = width - left - 24 - (figure.unit ? unit.getComputedTextLength() : 0);
  bar.append(element("rect", {x: left, y: 2, width: long, height: 14, fill: "url(#wafer-colours)"}));
  const ticks = figure.is_by_ratio ? logTicksOf(figure.low / factor, figure.high / factor, long / 70) : ticksOf(figure.low / factor, figure.high / factor, long / 80);
  for (const tick of ticks) {
    const x = left + long * shareOf(tick * factor, figure);
    const text = element("text", {x, y: 38, "text-anchor": "middle"}, shortNumber(tick));
    bar.append(element("line", {x1: x, x2: x, y1: 16, y2: 22, stroke: "var(--quiet)"}), text);
    const half = text.getComputedTextLength() / 2;
    text.setAttribute("x", Math.max(x, half + 1));
  }
}

// ---------------------------------------------------------------- parts side by side

const unitOrder = (a, b) => a.name.localeCompare(b.name, undefined, {numeric: true});

function drawUnits(figure) {
  byId("part-panel").hidden = !figure || !wafers.parts.length;
  if (byId("part-panel").hidden) return;
  say("parts-of", `by ${figure.label}`);
  const numbered = wafers.parts.map((part, number) => Object.assign({number}, part)).sort(unitOrder);
  const ofUnits = wafers.places.filter((place) => place.part !== null && place.values[figure.name] !== null);
  const isReleasing = !figure.unit;  // a margin or a peel number
  const limits = limitsOf(ofUnits.map((place) => place.values[figure.name]).concat(isReleasing ? [1] : []), true);
  const head = byId("unit-table").tHead.rows[0];
  const rows = numbered.map((part) => {
    const of = part.figures[figure.name];
    const row = document.createElement("tr");
    for (const text of [part.name, of.count === part.places ? String(of.count) : `${of.count} of ${part.places}`, of.text]) row.insertCell().textContent = text;
    const strip = element("svg", {class: "strip", role: "img", "aria-label": `each place of ${part.name}`});
    row.insertCell().append(strip);
    const [level, text] = verdictOf(part);
    const cell = row.insertCell();
    cell.className = level;
    cell.textContent = text;
    for (const one of row.cells) one.dataset.label = head.cells[one.cellIndex].textContent;
    return [row, () => drawStrip(strip, ofUnits.filter((place) => place.part === part.number), of.median, figure, limits, isReleasing)];
  });
  byId("units").replaceChildren(...rows.map(([row]) => row));
  for (const [, draw] of rows) draw();
  say("unit-keys", `Dots are places, the upright is their median${isReleasing ? ", the dashed line 1: sticks below" : ""}; from ${ofFigure(limits.low, figure)} to ${
      ofFigure(limits.high, figure)}${limits.log ? ", by ratios" : ""}.`);
}

/** What the node says of the part; else the verdicts on its places. */
function verdictOf(part) {
  const judged = (part.part || part.serial) && state.parts.find((one) => one.part === part.part && one.serial === part.serial);
  if (judged && judged.level !== "none") return [judged.level, judged.word];
  const words = {sticks: "stick", marginal: "marginal", releases: "release", unknown: "not known"};
  const level = ["sticks", "marginal", "unknown", "releases"].find((one) => part.levels[one]);
  return [level, Object.keys(words).filter((one) => part.levels[one]).map((one) => `${part.levels[one]} ${words[one]}`).join(", ")];
}

function drawStrip(svg, places, median, figure, limits, isReleasing) {
  const [width, height] = [svg.clientWidth, svg.clientHeight];
  if (!width) return;
  svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
  const of = limits.log ? Math.log : (value) => value;
  const at = (value) => 5 + (width - 10) * (of(value) - of(limits.low)) / (of(limits.high) - of(limits.low));
  svg.append(element("line", {x1: 5, x2: width - 5, y1: height / 2, y2: height / 2, stroke: "var(--grid)"}));
  if (isReleasing) svg.append(element("line", {x1: at(1), x2: at(1), y1: 0, y2: height, stroke: "var(--bad)", "stroke-width": 2, "stroke-dasharray": "4 3"}));
  for (const place of places) {
    const mark = element("circle", {cx: at(place.values[figure.name]), cy: height / 2, r: 4, fill: "var(--line)", "fill-opacity": 0.6});
    mark.append(element("title", {}, `${place.name}: ${place.texts[figure.name]}`));
    svg.append(mark);
  }
  if (median !== null) svg.append(element("line", {x1: at(median), x2: at(median), y1: 3, y2: height - 3, stroke: "var(--text)", "stroke-width": 3}));
}
