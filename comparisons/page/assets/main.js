// Puts the parts together.

const view = membraneView(document.getElementById("membranes"));
const outlines = document.getElementById("show-outlines");
const arrows = document.getElementById("show-arrows");
const arrowNote = document.getElementById("arrow-note");
const showReadout = startReadout();
let moveCursors = [];

function show(frame) {
  arrowNote.hidden = !arrows.checked;
  view.draw(frame, { outlines: outlines.checked, arrows: arrows.checked });
  showReadout(frame);
  for (const move of moveCursors) move(report.times[frame]);
}

function redraw() {
  const stops = report.concentrationStops[isDark() ? 1 : 0];
  document.getElementById("scale-bar").style.background = `linear-gradient(to right, ${stops.join(", ")})`;
  view.resize();
  show(player.current());
}

const player = startPlayer(show);
moveCursors = report.charts.map((chart) => drawChart(chart, document.getElementById("charts"), player.seek));
for (const box of [outlines, arrows]) box.addEventListener("change", redraw);
document.addEventListener("keydown", (event) => {
  const box = { v: arrows, o: outlines }[event.key];
  if (box && !event.ctrlKey && !event.altKey && !event.metaKey) box.click();
});
arrowNote.textContent =
  `(logarithmic: longest ${numberText(report.arrows.fastest)} nm/µs, none up to ${report.arrows.slowest})`;
window.addEventListener("resize", redraw);
startTheme(redraw);
player.seek(report.startTime);
document.documentElement.dataset.ready = "true";
