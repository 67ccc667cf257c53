// What all tabs of the station's page write with. All text goes in as text, never as HTML.
"use strict";

const byId = (id) => document.getElementById(id);
const say = (id, text) => { if (byId(id).textContent !== text) byId(id).textContent = text; };

const capital = (text) => text.slice(0, 1).toUpperCase() + text.slice(1);

function fillList(id, texts) {
  byId(id).replaceChildren(...texts.map((text) => { const item = document.createElement("li"); item.textContent = text; return item; }));
}

/** "12 s", "3 min", "2.5 h" */
function duration(seconds) {
  if (seconds < 120) return `${Math.round(seconds)} s`;
  return seconds < 7200 ? `${Math.round(seconds / 60)} min` : `${(seconds / 3600).toFixed(1)} h`;
}

function fillFigures(id, rows) {
  const figures = byId(id);
  figures.replaceChildren();
  for (const figure of rows) {
    const label = document.createElement("dt");
    const text = document.createElement("dd");
    label.textContent = figure.label;
    text.textContent = figure.text;
    text.dataset.name = figure.name;
    text.dataset.value = String(figure.value);
    figures.append(label, text);
  }
}

/** What the lines of a chart are: a piece of each, and its name. */
function fillKeys(id, ...groups) {
  byId(id).replaceChildren(...groups.flat().map(([colour, style, text]) => {
    const item = document.createElement("li");
    const piece = document.createElement("span");
    piece.style.borderTop = `3px ${style} ${colour}`;
    item.append(piece, text);
    return item;
  }));
}

function lengthText(metres) {
  const [factor, prefix] = prefixFor(metres);
  return `${Number((metres / factor).toPrecision(3))} ${prefix}m`;
}
