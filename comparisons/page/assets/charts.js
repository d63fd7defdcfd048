// Small line charts with a cursor at the time shown. All charts share one time axis.

// Smallest part of the largest value that a logarithmic axis shows: what is lower started from zero.
const SMALLEST_SHOWN = 1e-5;

// Smallest range of a linear axis that shows differences, relative to its values.
const LEAST_SPREAD = 1e-6;

const CHART = { width: 320, height: 176, left: 52, right: 16, top: 10, bottom: 24 };

function svgElement(name, attributes, parent) {
  const element = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  if (parent) parent.append(element);
  return element;
}

/** About `count` round numbers within [low, high]; powers of ten (and 2, 5 between them if few) for a logarithmic axis. */
function roundTicks(low, high, logarithmic, count) {
  if (logarithmic) {
    const decades = Math.log10(high / low);
    const factors = decades > 2.5 ? [1] : [1, 2, 5];
    const skip = Math.max(1, Math.ceil(decades / 5));
    const ticks = [];
    for (let power = Math.floor(Math.log10(low)); power <= Math.log10(high); power += skip) {
      for (const factor of factors) ticks.push(factor * 10 ** power);
    }
    return ticks.filter((tick) => tick >= low * 0.999 && tick <= high * 1.001);
  }
  const rough = (high - low) / count;
  const unit = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map((factor) => factor * unit).find((candidate) => candidate >= rough / 1.5);
  const ticks = [];
  for (let i = Math.ceil(low / step - 1e-9); i * step <= high + 1e-9 * step; ++i) ticks.push(i * step);
  return ticks;
}

/** True for a value that is written without a power of ten. */
function isPlain(value) {
  return value === 0 || (Math.abs(value) >= 1e-3 && Math.abs(value) < 1e5);
}

/** Texts of an axis' ticks: all plain, or all with powers of ten. */
function tickTexts(ticks) {
  return ticks.every(isPlain) ? ticks.map((tick) => String(+tick.toPrecision(4))) : ticks.map((tick) => powerText(+tick.toPrecision(4)));
}

/** A value with a power of ten and that many digits behind the point, without a number as many as it has; a factor of 1 is left out. */
function powerText(value, digits) {
  if (value === 0) return "0";
  const [factor, power] = value.toExponential(digits).split("e");
  return `${factor === "1" ? "" : `${factor.replace("-", "−")}·`}10${superscript(power.replace("+", ""))}`;
}

function superscript(text) {
  return [...text].map((digit) => (digit === "-" ? "⁻" : "⁰¹²³⁴⁵⁶⁷⁸⁹"[digit])).join("");
}

/** Map [low, high] to [from, to], linearly or logarithmically; returns the map with its inverse as `.inverse`. */
function axisMap(low, high, from, to, logarithmic) {
  const bend = logarithmic ? Math.log : (value) => value;
  const unbend = logarithmic ? Math.exp : (value) => value;
  const slope = (to - from) / (bend(high) - bend(low));
  const map = (value) => from + slope * (bend(value) - bend(low));
  map.inverse = (position) => unbend(bend(low) + (position - from) / slope);
  return map;
}

/** Smallest and largest finite value over all lines, with room around them. */
function valueRange(chart) {
  let low = Infinity, high = -Infinity;
  for (const line of chart.lines) {
    line.value.forEach((value, i) => {
      if (!Number.isFinite(value) || line.time[i] < report.timeAxis.first) return;
      low = Math.min(low, value);
      high = Math.max(high, value);
    });
  }
  if (low > high) return [0, 1];
  if (chart.logarithmic) return [Math.max(low / 1.15, high * SMALLEST_SHOWN), high * 1.15];
  if (chart.fromZero) low = Math.min(low, 0);
  // Values that differ by round-off alone are one value.
  const spread = high - low > LEAST_SPREAD * Math.abs(high) ? high - low : Math.abs(high) || 1;
  const room = spread * 0.06;
  return [chart.fromZero && low === 0 ? 0 : low - room, high + room];
}

function linePath(line, toX, toY) {
  let path = "", pen = "M";
  line.value.forEach((value, i) => {
    const y = toY(value);
    if (!Number.isFinite(y) || line.time[i] < report.timeAxis.first) { pen = "M"; return; }
    path += `${pen}${toX(line.time[i]).toFixed(1)} ${y.toFixed(1)}`;
    pen = "L";
  });
  return path;
}

/** Build one chart into `parent`; `seek(time)` is called on click and drag. Returns a function that moves the cursor. */
function drawChart(chart, parent, seek) {
  const figure = document.createElement("figure");
  const caption = document.createElement("figcaption");
  caption.textContent = `${chart.title} (${chart.unit})`;
  const svg = svgElement("svg", { viewBox: `0 0 ${CHART.width} ${CHART.height}`, role: "img", "aria-label": `${chart.title} against time`, class: chart.neutral ? "neutral" : "" });
  figure.append(caption, svg);
  parent.append(figure);

  const right = CHART.width - CHART.right, bottom = CHART.height - CHART.bottom;
  const { first, last, logarithmic } = report.timeAxis;
  const [low, high] = valueRange(chart);
  const toX = axisMap(first, last, CHART.left, right, logarithmic);
  const toY = axisMap(low, high, bottom, CHART.top, chart.logarithmic);
  const levels = roundTicks(low, high, chart.logarithmic, 4), times = roundTicks(first, last, logarithmic, 4);
  tickTexts(levels).forEach((text, i) => {
    const y = toY(levels[i]);
    svgElement("line", { class: "grid", x1: CHART.left, x2: right, y1: y, y2: y }, svg);
    svgElement("text", { x: CHART.left - 6, y: y + 4, "text-anchor": "end" }, svg).textContent = text;
  });
  tickTexts(times).forEach((text, i) => {
    const x = toX(times[i]);
    svgElement("line", { class: "grid", x1: x, x2: x, y1: CHART.top, y2: bottom }, svg);
    svgElement("text", { x, y: bottom + 16, "text-anchor": "middle" }, svg).textContent = text;
  });
  svgElement("text", { x: 4, y: bottom + 16 }, svg).textContent = "t (µs)";
  if (chart.level !== null && chart.level > low && chart.level < high) {
    svgElement("line", { class: "level", x1: CHART.left, x2: right, y1: toY(chart.level), y2: toY(chart.level) }, svg);
  }
  svgElement("path", { class: "frame", d: `M${CHART.left} ${CHART.top}V${bottom}H${right}`, style: "stroke-width:1" }, svg);
  // What is lower than a logarithmic axis shows ends at the axis.
  const clip = svgElement("clipPath", { id: `plot-area-${parent.children.length}` }, svg);
  svgElement("rect", { x: 0, y: 0, width: CHART.width, height: bottom }, clip);
  chart.lines.forEach((line, index) =>
    svgElement("path", { class: `series-${index}`, d: linePath(line, toX, toY), "clip-path": `url(#${clip.id})` }, svg));
  if (!chart.lines.some((line) => line.value.some(Number.isFinite))) {
    svgElement("text", { x: (CHART.left + right) / 2, y: (CHART.top + bottom) / 2, "text-anchor": "middle" }, svg).textContent =
      "none in either run";
  }
  const cursor = svgElement("line", { class: "cursor", y1: CHART.top, y2: bottom }, svg);

  const seekHere = (event) => {
    const box = svg.getBoundingClientRect();
    seek(toX.inverse(((event.clientX - box.left) / box.width) * CHART.width));
  };
  svg.addEventListener("pointerdown", (event) => { svg.setPointerCapture(event.pointerId); seekHere(event); });
  svg.addEventListener("pointermove", (event) => { if (event.buttons & 1) seekHere(event); });

  return (time) => {
    const x = Math.min(right, Math.max(CHART.left, toX(Math.max(time, first))));
    cursor.setAttribute("transform", `translate(${x.toFixed(1)} 0)`);
  };
}
