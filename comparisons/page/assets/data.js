// Unpacks the embedded data: arrays are little-endian float32 in base64.

/** Decode base64 text into a Float32Array. */
function floats(base64) {
  const bytes = Uint8Array.from(atob(base64), (character) => character.charCodeAt(0));
  return new Float32Array(bytes.buffer);
}

const report = JSON.parse(document.getElementById("report-data").textContent);
for (const run of report.runs) {
  for (const field of ["r", "z", "c", "u_r", "u_z"]) run[field] = floats(run[field]);
}
for (const chart of report.charts) {
  for (const line of chart.lines) {
    line.time = floats(line.time);
    line.value = floats(line.value);
  }
}
for (const row of report.readout) row.values = row.values.map(floats);
report.times = floats(report.times);
