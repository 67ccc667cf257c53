// The table of the parts: the newest verdict on each.
"use strict";

const PART_COLUMNS = [["part", (part) => part.part], ["serial number", (part) => part.serial], ["verdict", (part) => ORDER.indexOf(part.level)],
                      ["margin", (part) => part.ratio ? part.ratio.value : null], ["scans", (part) => parseInt(part.scans, 10)],
                      ["judged by", (part) => part.verdict_by], ["heard", (part) => -part.age]];
const ORDER = ["sticks", "marginal", "unknown", "releases", "none"]; // worst first
let sorting = {column: 6, sign: -1};  // those heard of last first

function showParts() {
  say("part-count", state.parts.length ? state.parts.length : "None yet: scans with a part_id or serial_id make some.");
  const head = byId("parts-head");
  if (!head.children.length) {
    head.append(...PART_COLUMNS.map(([name], column) => {
      const cell = document.createElement("th");
      const button = document.createElement("button");
      button.textContent = name;
      button.addEventListener("click", () => {
        sorting = {column, sign: sorting.column === column ? -sorting.sign : 1};
        showParts();
      });
      cell.append(button);
      return cell;
    }));
  }
  [...head.children].forEach((cell, column) => cell.setAttribute("aria-sort", column !== sorting.column ? "none" : sorting.sign > 0 ? "ascending" : "descending"));
  head.parentElement.parentElement.hidden = !state.parts.length;
  const labels = [...new Set(state.parts.filter((part) => part.ratio).map((part) => part.ratio.label))];
  head.children[3].firstChild.textContent = labels.length ? labels.join(", ") : "margin";
  byId("parts-body").replaceChildren(...sortedParts().map((part) => {
    const row = document.createElement("tr");
    row.className = part.level;
    for (const text of [part.part, part.serial, part.word, ratioWords(part), part.scans, part.verdict_by, `${duration(part.age + sinceState())} ago`]) {
      const cell = row.insertCell();
      cell.textContent = text;
      cell.dataset.label = head.children[cell.cellIndex].textContent;  // a small screen shows no head
    }
    row.title = [part.worst, part.reason].filter(Boolean).join(". ");
    return row;
  }));
}

function ratioWords(part) {
  return part.ratio ? part.ratio.text + (part.ratio.interval ? ` (${part.ratio.interval})` : "") : "says nothing yet";
}

/** What is not known comes last, whichever way. */
function sortedParts() {
  const valueOf = PART_COLUMNS[sorting.column][1];
  const isUnknown = (part) => valueOf(part) === null || Number.isNaN(valueOf(part));
  const compare = (a, b) => typeof a === "string" ? a.localeCompare(b, undefined, {numeric: true}) : a - b;
  return state.parts.slice().sort((a, b) => isUnknown(a) - isUnknown(b) || (isUnknown(a) ? 0 : sorting.sign * compare(valueOf(a), valueOf(b))));
}
