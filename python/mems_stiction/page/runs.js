// Sweeps of the voltage and contact cycles: the last of each that anybody ran.
"use strict";

const LOAD_COLOURS = ["var(--line)", "var(--warn)", "var(--good)", "var(--half-space)", "var(--fifth)", "var(--sixth)"];

function showRuns() {
  const {sweep, cycles} = state.runs;
  showRun("sweep", sweep, "None yet: sweep_load --voltages 0:30:5 makes one.", drawSweep);
  showRun("cycles", cycles, "None yet: cycle_contact --count 20 makes some.", drawCycles);
}

function showRun(name, run, none, draw) {
  const isDone = run && run.points;
  const running = run && run.progress ? `running, ${run.progress[0]} of ${run.progress[1]}` : "";
  say(`${name}-age`, running || (isDone ? `${duration(run.age + sinceState())} ago` : ""));
  // jumps stand below the charts, with their numbers
  const words = isDone ? run.sentences.filter((text) => !(run.jumps && text.startsWith("  jump from "))).concat(run.message ? [`Ended early: ${run.message}`] : []) : [running ? "" : none];
  fillList(`${name}-words`, words.filter(Boolean));
  byId(`${name}-charts`).style.display = isDone && run.points.length ? "" : "none";
  if (isDone && run.points.length) draw(run.points, run);
}

/** Contact area with its jumps, pull-off force, and margins with the safe voltage, as `sweep_load --plot` draws them. */
function drawSweep(points, run) {
  const loads = [...new Set(points.map((point) => point.load))];
  const colourOf = (load) => LOAD_COLOURS[Math.max(0, loads.indexOf(load)) % LOAD_COLOURS.length];
  const hasMargin = points.some((point) => point.held !== null || point.margin !== null);
  const highest = Math.max(...points.map((point) => point.voltage));
  const x = {label: "voltage", unit: "V", low: 0, high: highest * 1.03 || 1};
  const of = (load, way) => points.filter((point) => point.load === load && point.way === way);
  const loops = (valueOf) => loads.flatMap((load) => ["up", "down"].map((way) => ({
    // the way down begins where the way up has ended
    points: (way === "down" ? of(load, "up").slice(-1) : []).concat(of(load, way)).map((point) => [point.voltage, point.is_open ? null : valueOf(point)]),
    colour: colourOf(load), dash: way === "up" ? "none" : "7 5", width: 2.5})));
  const marks = (lines) => lines.flatMap((line) => line.points.map(([at, y]) => ({x: at, y, colour: line.colour, radius: 4})));
  const bands = (low, high) => loads.map((load) => ({points: of(load, "up").map((point) => [point.voltage, point[low], point[high]]), colour: colourOf(load)}));
  const limits = (areas, lines, more) => limitsOf(areas.flatMap((area) => area.points.flatMap((point) => point.slice(1)))
    .concat(lines.flatMap((line) => line.points.map((point) => point[1])), more), true);
  const pullIn = run.pull_in !== null && run.pull_in <= 1.2 * highest ? [{x: run.pull_in, colour: "var(--quiet)", dash: "9 4 2 4"}] : [];

  const [factor, unit] = Math.max(...points.map((point) => point.area || 0)) < 1e-14 ? [1e18, "nm\u00b2"] : [1e12, "\u00b5m\u00b2"];
  const areas = loops((point) => point.area === null ? null : point.area * factor);
  drawChart(byId("sweep-area"), {x, y: Object.assign({label: `${run.area_label} [${unit}]`}, limits([], areas, [])), lines: areas, marks: marks(areas), uprights: pullIn,
    numbers: run.jumps.map((jump) => ({x: jump.voltage, y: jump.area * factor, text: String(jump.number), isNumber: true}))});

  const forces = loops((point) => point.force);
  const forceBands = bands("force_lower", "force_upper");
  drawChart(byId("sweep-force"), {x, y: Object.assign({label: "pull-off force", unit: "N"}, limits(forceBands, forces, [])), areas: forceBands, lines: forces,
    marks: marks(forces), uprights: pullIn});

  byId("sweep-margin").style.display = hasMargin ? "" : "none";
  if (hasMargin) {
    const held = loops((point) => point.held);
    const free = loads.map((load) => ({points: of(load, "up").map((point) => [point.voltage, point.margin]), colour: colourOf(load), dash: "2 4", width: 2}));
    const marginBands = bands("lower", "upper");
    drawChart(byId("sweep-margin"), {x, y: Object.assign({label: "margin"}, limits(marginBands, held.concat(free), [1])), areas: marginBands, lines: held.concat(free),
      marks: marks(held), levels: [{y: 1, colour: "var(--bad)"}],
      uprights: pullIn.concat(run.safe.filter((one) => one.voltage !== null).map((one) => ({x: one.voltage, colour: colourOf(one.load), dash: "2 4"})))});
  }
  fillKeys("sweep-keys", loads.map((load) => [colourOf(load), "solid", `pressed with ${of(load, "up").concat(of(load, "down"))[0].load_text}`]),
           [["var(--text)", "solid", "voltage up"], ["var(--text)", "dashed", "voltage down"]],
           hasMargin ? [["var(--text)", "dotted", "margin once the load is gone; line: while it holds"], ["var(--bad)", "dashed", "1: stays closed below"]] : [],
           pullIn.length ? [["var(--quiet)", "dashed", "upright: pull-in"]] : [],
           hasMargin ? run.safe.map((one) => [colourOf(one.load), "dotted", `${run.safe.length > 1 ? `pressed with ${one.load_text}: ` : ""}${one.words}`]) : []);
  fillList("sweep-jumps", run.jumps.map((jump) => `${jump.number}  ${jump.words}`));
}

function drawCycles(points) {
  const value = points.some((point) => point.margin !== null) ? "margin" : "force";
  const last = points[points.length - 1].cycle;
  const shown = points.map((point) => [point.cycle, point[value]]);
  const lower = value === "margin" ? points.map((point) => [point.cycle, point.lower]) : [];
  drawChart(byId("cycles-chart"), {
    x: {label: "number of the contact", low: 0.5, high: Math.max(last, 5) + 0.5, whole: true},
    y: Object.assign(value === "margin" ? {label: "margin, dots: 95 %"} : {label: "pull-off", unit: "N"},
                     limitsOf(shown.concat(lower).map((point) => point[1]).concat(value === "margin" ? [1] : []), true)),
    lines: [{points: shown, colour: "var(--line)", width: 2.5}, {points: lower, colour: "var(--line)", width: 2, dash: "2 5"}],
    levels: value === "margin" ? [{y: 1, colour: "var(--bad)"}] : [],
  });
}

