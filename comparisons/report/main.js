// Puts the parts together.

const view = membraneView(document.getElementById("membranes"));
const outlines = document.getElementById("show-outlines");
const showReadout = startReadout();
let moveCursors = [];

function show(frame) {
  view.draw(frame, outlines.checked);
  showReadout(frame);
  for (const move of moveCursors) move(report.times[frame]);
}

function redraw() {
  view.resize();
  show(player.current());
}

const player = startPlayer(show);
moveCursors = report.charts.map((chart) => drawChart(chart, document.getElementById("charts"), player.seek));
outlines.addEventListener("change", redraw);
window.addEventListener("resize", redraw);
startTheme(redraw);
player.seek(report.startTime);
document.documentElement.dataset.ready = "true";
