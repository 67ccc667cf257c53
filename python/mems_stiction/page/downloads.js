// A panel as a picture: what is seen of its charts, maps and texts, at twice the size, with what it was made of and with below.
"use strict";

const PICTURE_SCALE = 2;
const PICTURE_EDGE = 16; // [px]

function addPictureButtons() {
  for (const panel of document.querySelectorAll(".panel[data-picture]")) {
    const button = document.createElement("button");
    button.className = "tool picture";
    button.textContent = "Picture";
    button.title = "Saves this as a PNG";
    button.addEventListener("click", () => savePicture(panel));
    panel.querySelector("h2").append(button);
  }
}

async function savePicture(panel) {
  const canvas = await pictureOf(panel);
  const blob = await new Promise((done) => canvas.toBlob(done, "image/png"));
  const link = document.createElement("a");
  link.href = URL.createObjectURL(blob);
  link.download = `${panel.dataset.picture}${state && state.scan ? `_scan_${state.scan.number}` : ""}.png`;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 60000);
}

async function pictureOf(panel) {
  const box = panel.getBoundingClientRect();
  const lines = state && state.scan ? [`Scan ${state.scan.number}${state.scan.name ? `: ${state.scan.name}` : ""}, ${state.scan.verdict.word}`, state.scan.origin] : [];
  const canvas = document.createElement("canvas");
  const [width, height] = [box.width + 2 * PICTURE_EDGE, box.height + 2 * PICTURE_EDGE + 20 * lines.length];
  canvas.width = width * PICTURE_SCALE;
  canvas.height = height * PICTURE_SCALE;
  const paper = canvas.getContext("2d");
  paper.scale(PICTURE_SCALE, PICTURE_SCALE);
  paper.fillStyle = getComputedStyle(document.documentElement).getPropertyValue("--panel");
  paper.fillRect(0, 0, width, height);
  const placeOf = (found) => { const at = found.getBoundingClientRect(); return [at.left - box.left + PICTURE_EDGE, at.top - box.top + PICTURE_EDGE, at.width, at.height]; };
  for (const map of panel.querySelectorAll(".map")) {
    paper.save();
    paper.beginPath();
    paper.rect(...placeOf(map));
    paper.clip();
    paper.imageSmoothingEnabled = false;
    for (const image of map.querySelectorAll("img")) {
      if (!image.naturalWidth) continue;
      paper.filter = getComputedStyle(image).filter;
      paper.drawImage(image, ...placeOf(image));
    }
    paper.restore();
  }
  for (const svg of panel.querySelectorAll("svg")) if (svg.clientWidth && svg.children.length) paper.drawImage(await imageOf(svg), ...placeOf(svg));
  for (const key of panel.querySelectorAll(".key, .keys span")) drawKey(paper, key, placeOf(key));
  drawTexts(paper, panel, box);
  paper.font = "14px \"DejaVu Sans\", Verdana, Arial, sans-serif";
  paper.fillStyle = getComputedStyle(document.documentElement).getPropertyValue("--quiet");
  lines.forEach((text, number) => paper.fillText(text, PICTURE_EDGE, height - PICTURE_EDGE - 20 * (lines.length - 1 - number), width - 2 * PICTURE_EDGE));
  return canvas;
}

/** An svg as an image; its styles go along, since a picture has none of the page's. */
async function imageOf(svg) {
  const copy = svg.cloneNode(true);
  const [originals, copies] = [svg.querySelectorAll("*"), copy.querySelectorAll("*")];
  originals.forEach((original, place) => {
    const style = getComputedStyle(original);
    for (const name of ["fill", "stroke", "stroke-width", "stroke-dasharray", "font-size", "font-family"]) copies[place].style.setProperty(name, style.getPropertyValue(name));
  });
  copy.setAttribute("xmlns", "http://www.w3.org/2000/svg");
  copy.setAttribute("width", svg.clientWidth * PICTURE_SCALE);
  copy.setAttribute("height", svg.clientHeight * PICTURE_SCALE);
  const address = URL.createObjectURL(new Blob([new XMLSerializer().serializeToString(copy)], {type: "image/svg+xml"}));
  const image = new Image();
  image.src = address;
  await image.decode();
  URL.revokeObjectURL(address);
  return image;
}

function drawKey(paper, key, [x, y, width, height]) {
  const style = getComputedStyle(key);
  if (key.classList.contains("key")) {
    paper.fillStyle = style.backgroundColor;
    paper.beginPath();
    paper.arc(x + width / 2, y + height / 2, width / 2, 0, 2 * Math.PI);
    paper.fill();
    return;
  }
  paper.strokeStyle = style.borderTopColor;
  paper.lineWidth = 3;
  paper.setLineDash({dashed: [7, 5], dotted: [3, 3]}[style.borderTopStyle] || []);
  paper.beginPath();
  paper.moveTo(x, y + 1.5);
  paper.lineTo(x + width, y + 1.5);
  paper.stroke();
  paper.setLineDash([]);
}

/** Word by word, where each stands. */
function drawTexts(paper, panel, box) {
  const walker = document.createTreeWalker(panel, NodeFilter.SHOW_TEXT);
  const range = document.createRange();
  paper.textBaseline = "middle";
  for (let node = walker.nextNode(); node; node = walker.nextNode()) {
    if (node.parentElement.closest("svg, button, a")) continue;
    const style = getComputedStyle(node.parentElement);
    paper.font = `${style.fontWeight} ${style.fontSize} ${style.fontFamily}`;
    paper.fillStyle = style.color;
    for (const word of node.textContent.matchAll(/\S+/g)) {
      range.setStart(node, word.index);
      range.setEnd(node, word.index + word[0].length);
      const at = range.getBoundingClientRect();
      if (at.width) paper.fillText(word[0], at.left - box.left + PICTURE_EDGE, at.top + at.height / 2 - box.top + PICTURE_EDGE);
    }
  }
  paper.textBaseline = "alphabetic";
}
