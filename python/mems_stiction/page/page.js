// The station's page: asks station_page for its state, and shows it. All text goes in as text, never as HTML.
"use strict";

const COLOURS = {releases: "var(--good)", marginal: "var(--warn)", sticks: "var(--bad)", unknown: "var(--quiet)", none: "var(--line)"};
const CONTROL = "var(--control)"; // of the control limits, as in plot_trend
const TITLE = "Stiction station";
const TELL_AGAIN = 10000; // [ms] between two scans of one verdict that are read aloud; another verdict is told at once
const RECONNECT = 1000;  // [ms]
const SILENCE = 8000;    // [ms] without a state: the server is gone
const FRESH = 10;        // [s] a warning of the node's diagnostics is shown at the top for so long
let state = null;
let received = 0;        // when the state came [ms]
let told = {word: null, at: -Infinity};  // what was read aloud last

const broken = {};       // parts of the page that cannot be shown: why

const sinceState = () => (performance.now() - received) / 1000;

function connect() {
  const socket = new WebSocket(`${location.protocol === "https:" ? "wss" : "ws"}://${location.host}/state`);
  socket.onopen = () => socket.send("next");
  socket.onmessage = (message) => {
    state = JSON.parse(message.data);
    received = performance.now();
    try { show(); } finally { socket.send("next"); }
  };
  socket.onclose = () => { setTimeout(connect, RECONNECT); };
}

/** What one part of the page cannot show hides no other part, and no later state. */
function attempt(name, part) {
  try {
    part();
    delete broken[name];
  } catch (error) {
    broken[name] = `${name} cannot be shown (${error.message})`;
    console.error(error);
  }
}

function show() {
  attempt("verdict", showVerdict);
  attempt("part", showPart);
  attempt("source", showSources);
  say("origin", state.scan ? state.scan.origin : "");
  say("counts", state.count ? `${state.count} scan${state.count === 1 ? "" : "s"}` + (state.lost ? `, ${state.lost} not predicted` : "") : "");
  showDownloads();
  showTab();
}

/** The title carries the verdict, and a screen reader hears a new one. */
function tellVerdict() {
  const verdict = byId("word").textContent;
  const word = verdict + (byId("provisional").hidden ? "" : " (provisional)");
  const isStale = byId("verdict").classList.contains("stale");
  const title = `${isStale ? "Old: " : ""}${word} \u00b7 ${TITLE}`;
  if (document.title !== title) document.title = title;
  const key = [word, isStale].join();
  const scan = state.count;
  if (told.word === key && (told.scan === scan || isStale || performance.now() - told.at < TELL_AGAIN)) return;
  told = {word: key, scan, at: performance.now()};
  const [label, ratio, interval] = ["ratio-label", "ratio-value", "ratio-interval"].map((id) => byId(id).textContent);
  say("told", isStale ? `What is shown is old: ${byId("age").textContent}.`
    : `${capital(byId("scan-name").textContent)}. ${word}${ratio ? `, ${label} ${ratio}` : ""}${interval ? `, ${interval}` : ""}.`);
}

function showLink() {
  const isGone = !state || performance.now() - received > SILENCE;
  const warned = !isGone && state.link.level === "ok" && state.diagnostics.find((status) => status.level !== "ok" && status.age < FRESH);
  const faults = isGone ? [] : state.broken.concat(Object.values(broken));
  byId("link").className = isGone ? "error" : warned || faults.length ? "warn" : state.link.level;
  say("link-text", isGone ? "No answer from station_page: what is shown is old." : faults.length ? `Not all is shown: ${faults.join("; ")}.` : warned ? `Connected; the node warns: ${warned.message}` : state.link.text);
  return isGone || state.link.level === "error";
}

function showVerdict() {
  const scan = state.scan;
  const box = byId("verdict");
  const isLost = state.loss_is_newest && state.losses.length > 0;
  const verdict = isLost ? {level: "unknown", word: "NOT PREDICTED", reason: state.losses[state.losses.length - 1].reason}
    : scan ? scan.verdict : {level: "none", word: "WAITING", reason: "The verdict appears with the first scan that is predicted."};
  const shownRatio = !isLost && scan && scan.ratio;
  box.dataset.level = verdict.level;
  box.classList.toggle("long", verdict.word.length > 9);
  say("word", verdict.word);
  say("reason", verdict.reason);
  const provisional = verdict.provisional || "";
  box.classList.toggle("provisional", Boolean(provisional));
  say("provisional", capital(provisional));
  byId("provisional").hidden = !provisional;
  say("scan-name", isLost ? `scan ${state.losses[state.losses.length - 1].number}` + (scan ? `; the last verdict, of scan ${scan.number}: ${scan.verdict.word}` : "")
    : scan ? `scan ${scan.number}` + (scan.name ? `: ${scan.name}` : "") : "no scan yet");
  say("ratio-label", shownRatio ? scan.ratio.label : "");
  say("ratio-value", shownRatio ? scan.ratio.text : "");
  say("ratio-interval", shownRatio ? scan.ratio.interval : "");
  const limits = scan && !isLost ? scan.flags.concat(scan.warnings.map((text) => `warning: ${text}`)) : [];
  say("limits-text", limits.join(" \u00b7 "));
  byId("limits").hidden = !limits.length;
  showAge();
}

function showPart() {
  const part = state.part;
  const box = byId("part");
  box.hidden = !part;
  setClasses(box, part ? [part.level, part.is_newest ? "" : "before"] : []);
  say("part-name", part ? capital(part.name) + (part.is_newest ? ":" : " (before the newest scan):") : "");
  say("part-word", part ? part.word + (part.is_provisional ? " (provisional)" : "") : "");
  say("part-ratio", part && part.ratio ? `${part.ratio.label} ${part.ratio.text}` + (part.ratio.interval ? ` (${part.ratio.interval})` : "") : "");
  say("part-scans", part ? [part.scans, part.worst, part.verdict_by && `by ${part.verdict_by}`].filter(Boolean).join(", ") + "." : "");
  const shown = part && part.is_newest && state.scan ? state.scan.flags : [];  // above, of the newest scan
  const flags = part ? part.flags.filter((text) => !shown.includes(text)) : [];
  // that of a part that releases is its interval, which stands above
  const said = part ? (part.level === "releases" && part.ratio ? [] : [part.reason]).concat(part.warnings.map((text) => `Warning: ${text}.`)) : [];
  say("part-reason", said.concat(flags.length ? [`Of its other scans: ${flags.join("; ")}.`] : []).join(" "));
}

/** What brings the scans: its last one, how many wait, what was refused and why. */
function showSources() {
  const lines = state.sources.map((source) => {
    const age = source.age + sinceState();
    const isSilent = age > source.silent_after;
    return {isWarning: isSilent || source.level !== "ok", text: (isSilent ? `Nothing heard of the source for ${duration(age)}. ` : "") + source.text};
  });
  byId("sources").hidden = !lines.length;
  byId("sources").classList.toggle("warn", lines.some((line) => line.isWarning));
  say("sources-text", lines.map((line) => line.text).join("\n"));
}

function showAge() {
  const isBroken = showLink();
  const age = state && state.age !== null ? state.age + sinceState() : null;
  const isStale = age !== null && (isBroken || age > state.stale_after);
  const box = byId("verdict");
  setClasses(box, [isStale ? "stale" : box.dataset.level || "none", ...["long", "provisional"].filter((name) => box.classList.contains(name))]);
  say("age", isStale ? `last scan ${duration(age)} ago` : "");
  if (state) tellVerdict();
}

/** Those of a box, which stays unfolded or not. */
function setClasses(box, names) {
  const classes = names.concat("box", box.classList.contains("unfolded") ? "unfolded" : []).filter(Boolean).join(" ");
  if (box.className !== classes) box.className = classes;
}

/** A button for each box whose text is cut, as long as that is so. */
function showUnfolding() {
  for (const box of document.querySelectorAll(".box")) {
    const button = box.querySelector(".unfold");
    const text = byId(button.getAttribute("aria-controls"));
    const isUnfolded = box.classList.contains("unfolded");
    const isCut = text.textContent.trim() !== "" && text.scrollHeight > text.clientHeight + 1 || !text.clientHeight;
    button.hidden = !isUnfolded && !isCut;
    button.setAttribute("aria-expanded", String(isUnfolded));
    const what = button.dataset.what ||= button.textContent;
    const words = isUnfolded ? "less" : what;
    if (button.textContent !== words) button.textContent = words;
  }
}

// ---------------------------------------------------------------- tabs

const TABS = {overview: showOverview, maps: showMaps, curve: showCurve, runs: showRuns, parts: showParts, wafers: showWafers, node: showNode};

function chosenTab() {
  const name = location.hash.slice(1);
  return Object.prototype.hasOwnProperty.call(TABS, name) ? name : "overview";
}

function showTab() {
  const chosen = chosenTab();
  for (const button of document.querySelectorAll("nav button")) {
    const isChosen = button.dataset.tab === chosen;
    button.classList.toggle("chosen", isChosen);
    button.setAttribute("aria-selected", String(isChosen));
    button.tabIndex = isChosen ? 0 : -1;  // arrow keys lead to the others
  }
  document.body.classList.toggle("compact", chosen !== "overview");
  for (const tab of document.querySelectorAll(".tab")) tab.classList.toggle("chosen", tab.id === `tab-${chosen}`);
  if (state) attempt(chosen, TABS[chosen]);
  showUnfolding();
}

/** Arrow keys, Home and End among the tabs. */
function followKeys(event) {
  const buttons = [...document.querySelectorAll("nav button")];
  const at = buttons.indexOf(event.target);
  const to = {ArrowRight: at + 1, ArrowLeft: at - 1, Home: 0, End: buttons.length - 1}[event.key];
  if (to === undefined || at < 0) return;
  event.preventDefault();
  const button = buttons[(to + buttons.length) % buttons.length];
  button.focus();
  button.click();
}

function showOverview() {
  showTrend();
  fillFigures("figures", state.scan ? state.scan.figures : []);
  showDevice();
}

/** The whole device's force; by an earlier scan as long as that of the newest is on its way. */
function showDevice() {
  const device = state.device;
  say("device-of", device && device.number ? `by scan ${device.number}` : "");
  say("device-words", !device ? "No force of a whole device yet." : !device.is_found ? `Not found: ${device.message}` :
      `${device.verdict.word}` + (device.ratio ? `, ${device.ratio.label} ${device.ratio.text}` + (device.ratio.interval ? ` (${device.ratio.interval})` : "") : "") +
      `; by ${device.scans}` + (device.part ? ` of ${device.part}.` : "."));
  fillFigures("device-figures", device ? device.figures : []);
}

/** Downloads of rows are there as soon as there are rows. */
function showDownloads() {
  byId("scan-row").hidden = !state.scan;
  byId("part-rows").hidden = !state.parts.length;
}

function showTrend() {
  const rows = state.trend;
  const first = rows.length ? rows[0].number : 1;
  const x = {label: "number of the scan", low: first - 0.7, high: Math.max(rows.length ? rows[rows.length - 1].number : 1, first + 9) + 0.7, whole: true};
  const bands = rows.filter((row) => row.lost !== undefined).map((row) => row.number);
  const valueOf = (row, name) => row.lost === undefined ? row[name] : null;
  const isDevice = rows.some((row) => valueOf(row, "device_force") !== null);
  const force = isDevice ? "device_force" : "force";
  const forces = rows.map((row) => valueOf(row, force));
  const springs = isDevice ? rows.map((row) => valueOf(row, "restoring_force")) : [];
  const numbers = rows.map((row) => row.number);
  const ratios = rows.map((row) => valueOf(row, "ratio"));
  const hasRatio = ratios.some((value) => value !== null);
  const control = state.control && state.control.of === force ? state.control : null;
  const line = (values) => values.map((value, place) => [numbers[place], value]);
  const marks = (values) => rows.map((row, place) => ({x: row.number, y: values[place], colour: COLOURS[row.level] || COLOURS.none}));
  drawChart(byId("trend-force"), {
    x: Object.assign({}, x, {label: hasRatio ? "" : x.label}), bands,
    y: Object.assign({label: isDevice ? "pull-off, device" : "pull-off, scan", unit: "N"}, limitsOf(forces.concat(springs, control ? [control.lower, control.upper] : []), true)),
    lines: (control ? controlLines(control) : []).concat([{points: line(forces), colour: "var(--line)", width: 1.5}, {points: line(springs), colour: "var(--good)", width: 2.5, dash: "8 5"}]),
    marks: marks(forces), rings: control ? control.outside.map((number) => ({x: number, y: forces[numbers.indexOf(number)], colour: CONTROL})) : [],
  });
  const hasSpring = springs.some((value) => value !== null && value !== undefined);
  fillKeys("trend-keys", hasSpring ? [["var(--good)", "dashed", "restoring force of the spring"]] : [],
           control ? [[CONTROL, "dotted", "control limits"], [CONTROL, "solid", "their centre"]] : [],
           hasRatio ? [["var(--quiet)", "solid", "95 %"], ["var(--bad)", "dashed", "1: sticks below"]] : []);
  byId("trend-ratio").style.display = hasRatio ? "block" : "none";
  if (!hasRatio) return;
  const whiskers = rows.map((row) => [row.number, valueOf(row, "lower"), valueOf(row, "upper")]);
  drawChart(byId("trend-ratio"), {
    x, y: Object.assign({label: state.scan && state.scan.ratio ? state.scan.ratio.label : "margin"}, limitsOf(ratios.concat(whiskers.flatMap((one) => one.slice(1)), [1]), true)),
    bands, whiskers, levels: [{y: 1, colour: "var(--bad)"}], lines: [{points: line(ratios), colour: "var(--line)", width: 1.5}], marks: marks(ratios),
  });
}

/** Both limits and, thinner, the centre, over the scans that they are of. */
function controlLines(control) {
  return [["lower", "2 4", 2], ["centre", "none", 1], ["upper", "2 4", 2]].map(([name, dash, width]) => ({
    points: [[control.first - 0.5, control[name]], [control.last + 0.5, control[name]]], colour: CONTROL, width, dash}));
}

// ---------------------------------------------------------------- force curve

function showCurve() {
  const curve = state.scan && state.scan.curve;
  const half = state.half_space;
  const halfCurve = half && half.is_solved && half.in.length + half.out.length ? half : null;
  say("curve-words", curve ? `Scan ${state.scan.number}, ${curve.formulation.replace(/_/g, " ")}: pull-off force ${curve.text}, at ${signedLength(curve.peak[0])}.` :
      state.scan ? "This formulation does not follow the force over the height." : "No scan yet.");
  say("half-space", half ? `Half-space${half.number ? " of scan " + half.number : ""}: ${half.status}. ` +
      (half.is_solved ? `Pull-off force ${half.text}.` : half.message) +
      (half.verdict ? ` Judged by ${half.verdict.by}: ${half.verdict.word}, ${half.verdict.ratio.label} ${half.verdict.ratio.text}` +
        (half.verdict.ratio.interval ? ` (${half.verdict.ratio.interval})` : "") + "." : "") + half.notes.map((note) => ` But ${note}.`).join("") : "");
  const all = [curve, halfCurve].filter(Boolean).flatMap((one) => one.in.concat(one.out));
  fillKeys("curve-keys", curve ? [["var(--line)", "solid", "approach"], ["var(--warn)", "solid", "retraction"]] : [],
           halfCurve ? [["var(--half-space-in)", "dotted", "half-space, approach"], ["var(--half-space)", "solid", "half-space, retraction"]] : []);
  if (!all.length) { byId("force-curve").replaceChildren(); return; }
  const strongest = Math.max(...all.map((point) => point[1]), 1e-30);
  const near = all.filter((point) => Math.abs(point[1]) > 0.02 * strongest && point[1] > -1.2 * strongest);
  const places = (near.length > 1 ? near : all).map((point) => point[0]);
  const room = 0.05 * (Math.max(...places) - Math.min(...places)) || 1e-10;
  const forces = all.filter((point) => point[1] > -1.2 * strongest).map((point) => point[1]);
  const lines = [];
  if (halfCurve) lines.push({points: half.in, colour: "var(--half-space-in)", width: 2, dash: "2 5"}, {points: half.out, colour: "var(--half-space)", width: 2.5});
  if (curve) lines.push({points: curve.in, colour: "var(--line)", width: 3}, {points: curve.out, colour: "var(--warn)", width: 2.5});
  drawChart(byId("force-curve"), {
    x: {label: "displacement past first touch; below 0 apart", unit: "m", low: Math.min(...places) - room, high: Math.max(...places) + room},
    y: Object.assign({label: "force, above 0 attraction", unit: "N"}, limitsOf(forces, false)), lines,
    marks: curve ? [{x: curve.peak[0], y: curve.peak[1], colour: "var(--bad)", radius: 8}] : [],
    texts: curve ? [{x: curve.peak[0], y: curve.peak[1], text: `pull-off ${curve.text}`}] : [],
  });
}

function signedLength(metres) {
  if (Math.abs(metres) < 5e-14) return "first touch";
  return `${lengthText(Math.abs(metres))} ${metres < 0 ? "apart" : "past first touch"}`;
}

// ---------------------------------------------------------------- the node

function showNode() {
  fillFigures("trace", state.scan ? state.scan.trace : []);
  fillList("losses", state.losses.length ? state.losses.slice().reverse().map((loss) =>
    (loss.count > 1 ? `${loss.count} scans, the last ${loss.number}: ` : `scan ${loss.number}: `) + (loss.reason || "no reason given"))
    : [state.count ? "None: every scan since station_page was started is predicted." : "No scan yet."]);
  fillList("preprocessing", state.scan && state.scan.preprocessing.length ? state.scan.preprocessing : ["Nothing: it is predicted as it came."]);
  const box = byId("diagnostics");
  box.replaceChildren();
  if (!state.diagnostics.length) box.textContent = "The node has told nothing yet.";
  for (const status of state.diagnostics) {
    const heading = document.createElement("p");
    heading.className = `status ${status.level}`;
    heading.textContent = `${status.name}: ${status.message} (${duration(status.age + sinceState())} ago)`;
    const table = document.createElement("table");
    for (const [key, value] of status.values) {
      const row = table.insertRow();
      row.insertCell().textContent = key;
      row.insertCell().textContent = value;
    }
    box.append(heading, table);
  }
}

for (const button of document.querySelectorAll("nav button")) button.addEventListener("click", () => { location.hash = button.dataset.tab; });
document.querySelector("nav").addEventListener("keydown", followKeys);
for (const box of document.querySelectorAll(".box")) box.addEventListener("click", () => { box.classList.toggle("unfolded"); if (state) show(); else showUnfolding(); });
addPictureButtons();
window.addEventListener("hashchange", showTab);
window.addEventListener("resize", () => { if (state) show(); });
setInterval(showAge, 500);
showTab();
connect();
