"use strict";
// Neck, height, energy and a coat's maturity against time, each with the kept curve behind it.

/** Round numbers from `low` ≤ 0 to `high` > 0, some `count` of them and 0. */
function ticks(low, high, count) {
  const rough = (high - low) / count, power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map((x) => x * power).find((x) => x >= rough * 0.999);
  const whole = (value) => Math.floor((value / step) * (1 + 1e-9));
  return Array.from({ length: whole(high) + whole(-low) + 1 }, (_, i) => Number(((i - whole(-low)) * step).toPrecision(9)));
}

class Chart {
  /** `column`: of a row {time, neck, height, energy, maturity}. */
  constructor(canvas, column, name, unit) {
    Object.assign(this, { canvas, column, name, unit });
  }

  values(rows) { return rows.filter((row) => row[this.column] !== null); }

  /** `run`, `kept`: {rows, events}. `time`: of the membrane that is shown, when it is not the last one. */
  draw({ rows, events }, kept, time) {
    const { context, width, height } = fitted(this.canvas);
    const colours = theme();
    const own = this.values(rows), old = kept ? this.values(kept.rows) : [];
    const all = own.concat(old), left = 46, bottom = height - 20, top = 8, right = width - 8;
    const end = Math.max(rows.at(-1)?.time ?? 0, kept?.rows.at(-1)?.time ?? 0) || 1;
    const beyond = (value) => (value > 1e-6 ? 1.06 * value : 0);  // less is round-off of a membrane at rest
    const low = -beyond(all.reduce((value, row) => Math.max(value, -row[this.column]), 0));
    const high = beyond(all.reduce((value, row) => Math.max(value, row[this.column]), 0)) || (low < 0 ? -0.06 * low : 1.06);
    const x = (t) => left + ((right - left) * t) / end, y = (value) => bottom - ((bottom - top) * (value - low)) / (high - low);
    context.font = "12px system-ui, sans-serif";
    context.lineWidth = 1;
    context.strokeStyle = colours.grid;
    context.fillStyle = colours.muted;
    context.textAlign = "right";
    context.textBaseline = "middle";
    for (const mark of ticks(low, high, 3)) {
      context.beginPath();
      context.moveTo(left, y(mark));
      context.lineTo(right, y(mark));
      context.stroke();
      context.fillText(Math.abs(mark) >= 1e4 ? `${short(mark / 1e3)}k` : String(mark), left - 6, y(mark));
    }
    context.textBaseline = "alphabetic";
    const marks = ticks(0, end, Math.max(3, Math.floor(width / 70)));
    marks.forEach((mark, i) => {
      context.textAlign = i === 0 ? "left" : x(mark) > right - 14 ? "right" : "center";
      context.fillText(i === marks.length - 1 ? `${mark} µs` : String(mark), x(mark), height - 4);
    });
    this.line(context, old, x, y, colours.kept, [5, 4]);
    this.line(context, own, x, y, colours.accent, []);
    this.mark(context, old, kept?.events, x, y, colours.kept);
    this.mark(context, own, events, x, y, colours.coated);
    if (time !== undefined && rows.length) {
      context.strokeStyle = colours.muted;
      context.beginPath();
      context.moveTo(x(time), top);
      context.lineTo(x(time), bottom);
      context.stroke();
    }
  }

  line(context, rows, x, y, colour, dash) {
    context.setLineDash(dash);
    context.strokeStyle = colour;
    context.lineWidth = 2;
    context.beginPath();
    for (const row of rows) context.lineTo(x(row.time), y(row[this.column]));
    context.stroke();
    context.setLineDash([]);
  }

  /** A dot where the bud has budded. */
  mark(context, rows, events, x, y, colour) {
    const time = events?.budding?.time_us, after = rows.findIndex((row) => row.time >= time);
    if (time === undefined || after < 1) return;
    const [a, b] = [rows[after - 1], rows[after]], part = (time - a.time) / (b.time - a.time);
    context.fillStyle = colour;
    context.beginPath();
    context.arc(x(time), y(a[this.column] + part * (b[this.column] - a[this.column])), 4, 0, 2 * Math.PI);
    context.fill();
  }

  /** What a screen reader is told. */
  describe(rows) {
    const own = this.values(rows);
    const words = own.length
      ? `from ${short(own[0][this.column])} at ${short(own[0].time)} µs to ${short(own.at(-1)[this.column])} at ${short(own.at(-1).time)} µs`
      : "no values";
    this.canvas.setAttribute("aria-label", `${this.name} in ${this.unit} against time: ${words}`);
  }
}
