// Heights and contacts of the newest scan: colour bar, zoom, and what a click measures. Both maps show the same piece of the scan.
"use strict";

const VIRIDIS = ["#440154", "#472d7b", "#3b528b", "#2c728e", "#21918c", "#28ae80", "#5ec962", "#addc30", "#fde725"];
const REGIMES = ["", "#2f9bff", "#ffd23f", "#ff4d4d"]; // elastic, elasto-plastic, plastic
const THINNED = 512;    // pixels of a map's longer side that the plain picture has
const MOST_ZOOM = 64;
const BAR_WIDTH = 92;   // of the colour bar with its numbers [px]
const BELOW = 120;      // that what stands below a map takes [px]
const WIDE = 1.7;       // width over height of a scan from which the maps stand below each other
const GAP = 26;         // between two panels [px]
const TURNED = 0.5;     // width over height of a scan below which it is shown lying
const view = {x: 0, y: 0, zoom: 1}; // of the upper left corner, as shares of the scan
const shownMaps = {};
let measured = {id: null, places: [], told: null}; // places: [x, y] as shares of the scan

/** From the scan to what is shown, which lies on its side where the scan is upright and narrow, and back; shares of both. */
const isTurned = () => { const any = state.maps.height || state.maps.contacts; const [width, length] = any.size || [any.columns, any.rows]; return width < TURNED * length; };
const turn = ([x, y]) => isTurned() ? [1 - y, x] : [x, y];
const turnBack = ([x, y]) => isTurned() ? [y, 1 - x] : [x, y];

const ofScan = (map) => map.number ? `of scan ${map.number}` : "";

function showMaps() {
  const {height, contacts} = state.maps;
  const any = height || contacts;
  byId("map-tools").hidden = !any;
  if (!any) { say("height-legend", ["No map yet."].concat(state.map_notes).join(" ")); return; }
  const [width, length] = any.size || [any.columns, any.rows];
  fitMaps(isTurned() ? length / width : width / length);
  say("height-of", height ? ofScan(height) : "");
  say("contacts-of", contacts ? ofScan(contacts) : "");
  say("height-legend", "after contact, above the mean; mauve: not measured" + (any.size ? `; ${lengthText(width)} x ${lengthText(length)}` : "") + (isTurned() ? ", turned clockwise" : "") + state.map_notes.map((note) => ` ${note}`).join(""));
  if (height) for (const id of ["height", "relief"]) load(id, addressOf("height", height));
  if (contacts) load("contacts", addressOf("contacts", contacts));
  if (measured.id !== null && (!height || measured.id !== height.id)) clearMeasured();
  drawBar();
  placeMaps();
  showMeasured();
}

/** A piece of a large map is looked at in all its pixels. */
const addressOf = (name, map) => `map/${name}.png?${view.zoom > 1 && Math.max(map.columns, map.rows) > THINNED ? "zoomed&" : ""}${isTurned() ? "turned&" : ""}${map.id}`;

/** As large as the tab and the window allow, in the scan's own aspect: beside each other or, if it is wide, below each other. */
function fitMaps(aspect) {
  const tab = byId("tab-maps");
  const isStacked = aspect > WIDE || tab.clientWidth < 700 || window.matchMedia("(orientation: portrait)").matches; // as the style sheet has it
  tab.classList.toggle("stacked", isStacked);
  // one that stands below another, or is upright, may fill the window
  const room = Math.max(240, window.innerHeight - BELOW - (isStacked || aspect < 1 ? 40 : tab.getBoundingClientRect().top + window.scrollY));
  const width = Math.max(60, Math.min((isStacked ? tab.clientWidth : (tab.clientWidth - GAP) / 2) - BAR_WIDTH, room * aspect));
  for (const map of document.querySelectorAll(".map")) {
    map.style.width = `${width}px`;
    map.style.height = `${width / aspect}px`;
  }
}

/** A map that is still on its way is not asked for again. */
function load(id, address) {
  const image = byId(id);
  if (shownMaps[id] === address || (image.dataset.address && !image.complete)) return;
  shownMaps[id] = address;
  image.dataset.address = address;
  image.src = address;
}

function drawBar() {
  const bar = byId("height-bar");
  const range = state.height_range;
  const height = byId("height").parentElement.parentElement.clientHeight;
  bar.replaceChildren();
  if (!range || !(range[1] > range[0])) return;
  bar.setAttribute("viewBox", `0 0 ${BAR_WIDTH} ${height}`);
  bar.style.height = `${height}px`;
  const gradient = element("linearGradient", {id: "viridis", x1: 0, x2: 0, y1: 1, y2: 0});
  VIRIDIS.forEach((colour, place) => gradient.append(element("stop", {offset: place / (VIRIDIS.length - 1), "stop-color": colour})));
  bar.append(gradient, element("rect", {x: 8, y: 24, width: 16, height: Math.max(1, height - 32), fill: "url(#viridis)"}));
  const [factor, prefix] = prefixFor(Math.max(Math.abs(range[0]), Math.abs(range[1])));
  bar.append(element("text", {class: "label", x: 8, y: 15}, `${prefix}m`));
  for (const tick of ticksOf(range[0] / factor, range[1] / factor, Math.max(2, (height - 32) / 50))) {
    const y = height - 8 - (tick * factor - range[0]) / (range[1] - range[0]) * (height - 32);
    bar.append(element("line", {x1: 24, x2: 29, y1: y, y2: y, stroke: "var(--quiet)"}), element("text", {x: 33, y: Math.min(Math.max(y + 5, 29), height - 2)}, shortNumber(tick)));
  }
}

// ---------------------------------------------------------------- zoom

/** Both maps show the piece of the view; rings and marks keep their size. */
function placeMaps() {
  view.zoom = Math.min(Math.max(view.zoom, 1), MOST_ZOOM);
  for (const axis of ["x", "y"]) view[axis] = Math.min(Math.max(view[axis], 0), 1 - 1 / view.zoom);
  for (const map of document.querySelectorAll(".map")) {
    map.classList.toggle("zoomed", view.zoom > 1);
    const [width, height] = [map.clientWidth, map.clientHeight];
    map.querySelector(".layer").style.transform = `scale(${view.zoom}) translate(${-100 * view.x}%, ${-100 * view.y}%)`;
    const over = map.querySelector("svg");
    over.setAttribute("viewBox", `0 0 ${width} ${height}`);
    const placeOf = ([x, y]) => [(x - view.x) * view.zoom * width, (y - view.y) * view.zoom * height];
    over.replaceChildren(...(over.id === "rings" ? drawnRings(placeOf, width, height) : []), ...drawnMarks(placeOf));
  }
  say("zoom-text", view.zoom > 1 ? `${Number(view.zoom.toPrecision(2))} times` : "whole scan");
}

function drawnRings(placeOf, width, height) {
  return state.rings.map(([x, y, regime]) => [placeOf(turn([x, y])), regime]).filter(([[x, y]]) => x > -20 && y > -20 && x < width + 20 && y < height + 20)
    .map(([[cx, cy], regime]) => element("ellipse", {cx, cy, rx: 9, ry: 9, fill: "none", "stroke-width": 2.5, stroke: REGIMES[regime]}));
}

function drawnMarks(placeOf) {
  const ends = measured.places.map((place) => placeOf(turn(place)));
  const line = ends.length === 2 ? [element("line", {class: "measure", x1: ends[0][0], y1: ends[0][1], x2: ends[1][0], y2: ends[1][1]})] : [];
  return line.concat(ends.map(([cx, cy]) => element("circle", {class: "measure", cx, cy, r: 6})));
}

/** About a point that stays where it is: shares of the map's width and height. */
function zoomBy(factor, [x, y] = [0.5, 0.5]) {
  const before = view.zoom;
  view.zoom = Math.min(Math.max(before * factor, 1), MOST_ZOOM);
  view.x += x / before - x / view.zoom;
  view.y += y / before - y / view.zoom;
  if (state) showMaps();
}

/** One finger or the mouse: a click measures, a drag moves a map that is zoomed. Two fingers zoom. */
function followPointers(map) {
  const pointers = new Map();
  let moved = 0;
  const shareOf = (event) => {
    const box = map.getBoundingClientRect();
    return [(event.clientX - box.left) / box.width, (event.clientY - box.top) / box.height];
  };
  const spread = () => { const [[x0, y0], [x1, y1]] = [...pointers.values()]; return Math.hypot((x1 - x0) * map.clientWidth, (y1 - y0) * map.clientHeight); };
  map.addEventListener("pointerdown", (event) => {
    if (!pointers.size) moved = 0;
    pointers.set(event.pointerId, shareOf(event));
    map.setPointerCapture(event.pointerId);
  });
  map.addEventListener("pointermove", (event) => {
    if (!pointers.has(event.pointerId)) return;
    const [x, y] = shareOf(event);
    const [x0, y0] = pointers.get(event.pointerId);
    const before = pointers.size === 2 ? spread() : 0;
    moved += Math.hypot((x - x0) * map.clientWidth, (y - y0) * map.clientHeight);
    pointers.set(event.pointerId, [x, y]);
    if (pointers.size === 2 && before > 0) {
      const [[ax, ay], [bx, by]] = [...pointers.values()];
      return zoomBy(spread() / before, [(ax + bx) / 2, (ay + by) / 2]);
    }
    if (pointers.size !== 1 || moved < 5) return;
    view.x -= (x - x0) / view.zoom;
    view.y -= (y - y0) / view.zoom;
    if (state) placeMaps();
  });
  const end = (event) => {
    const isClick = pointers.size === 1 && moved < 5 && event.type === "pointerup";
    pointers.delete(event.pointerId);
    if (isClick && state) measureAt(shareOf(event));
  };
  map.addEventListener("pointerup", end);
  map.addEventListener("pointercancel", end);
  map.addEventListener("wheel", (event) => {
    event.preventDefault();
    zoomBy(event.deltaY < 0 ? 1.3 : 1 / 1.3, shareOf(event));
  }, {passive: false});
}

// ---------------------------------------------------------------- measuring

/** The first click tells a height, the second a distance too, the third begins anew. */
async function measureAt([x, y]) {
  const map = state.maps.height;
  if (!map) return;
  const place = turnBack([view.x + x / view.zoom, view.y + y / view.zoom].map((share) => Math.min(Math.max(share, 0), 1)));
  const places = measured.places.length === 1 ? measured.places.concat([place]) : [place];
  const now = measured = {id: map.id, places, told: null};
  placeMaps();
  showMeasured();
  const answer = await fetch(`measure?id=${map.id}${places.map(([px, py]) => `&x=${px}&y=${py}`).join("")}`);
  if (measured !== now) return;  // another click, or another scan
  if (!answer.ok) { clearMeasured(); placeMaps(); } else now.told = await answer.json();
  showMeasured();
}

function clearMeasured() { measured = {id: null, places: [], told: null}; }

function signedHeight(metres) {
  return metres === null ? "not measured" : `${metres < 0 ? "\u2212" : ""}${lengthText(Math.abs(metres))}`;
}

function showMeasured() {
  const {told, places} = measured;
  byId("measure-clear").hidden = !places.length;
  if (!told) { say("measured", places.length ? "Measuring." : state.maps.height ? "A click tells the height there, a second one the distance." : ""); return; }
  const words = told.points.map((point, number) => `${told.points.length > 1 ? `Point ${number + 1}` : "Height"}: ${signedHeight(point.height)}` +
      (point.x !== null ? ` at x ${lengthText(point.x)}, y ${lengthText(point.y)}` : ""));
  if (told.points.length === 2) {
    words.push(`distance ${told.distance === null ? "not known, since the pitch is not stated" : lengthText(told.distance)}`);
    words.push(told.step === null ? "step not known" : `step ${signedHeight(told.step)}`);
  }
  say("measured", `${words.join("; ")}.`);
}

for (const map of document.querySelectorAll(".map")) followPointers(map);
byId("zoom-in").addEventListener("click", () => zoomBy(2));
byId("zoom-out").addEventListener("click", () => zoomBy(0.5));
byId("zoom-whole").addEventListener("click", () => zoomBy(0));
byId("measure-clear").addEventListener("click", () => { clearMeasured(); if (state) showMaps(); });
