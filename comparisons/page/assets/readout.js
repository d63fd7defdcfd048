// The clock and the table of values at the time shown.

/** Four significant digits, or a dash where there is no value. */
function numberText(value) {
  if (!Number.isFinite(value)) return "–";
  const size = Math.abs(value);
  if (size !== 0 && size < 1e-3) return powerText(value, 2);
  return size >= 1000 ? value.toFixed(0) : value.toPrecision(4);
}

/** Fill the table's rows once; returns a function that shows a frame. */
function startReadout() {
  const body = document.getElementById("readout");
  const clock = document.getElementById("clock");
  const note = document.getElementById("clock-note");
  const rows = report.readout.map((row) => {
    const line = body.insertRow();
    const head = document.createElement("th");
    head.scope = "row";
    head.append(row.title, " ", Object.assign(document.createElement("span"), { className: "unit", textContent: row.unit }));
    line.append(head);
    const cells = row.values.map(() => line.insertCell());
    if (cells.length === 1) cells[0].colSpan = 2;
    return cells;
  });
  return (frame) => {
    clock.textContent = timeText(frame);
    note.textContent = report.interpolated[frame] ? "between output times: interpolated" : "as written by both runs";
    rows.forEach((cells, i) => cells.forEach((cell, j) => { cell.textContent = numberText(report.readout[i].values[j][frame]); }));
  };
}

/** Time of a frame with as many decimals as the frames need. */
function timeText(frame) {
  const last = report.times[report.times.length - 1];
  return report.times[frame].toFixed(last < 0.1 ? 5 : last < 10 ? 3 : 2);
}
