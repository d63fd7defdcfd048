// Time, mode and shape are chosen here; the picture turns by itself until it is dragged or stopped.

const report = JSON.parse(document.getElementById("report-data").textContent);
const canvas = document.getElementById("view");
const view = surfaceView(canvas, report.frames);
const time = document.getElementById("time"), amount = document.getElementById("amount");
const turn = document.getElementById("turn");
const SECONDS_PER_TURN = 14;
let angle = 0.6, turning = true, last = performance.now(), chosen = 0;

const signed = (value) => `${value < 0 ? "−" : "+"}${Math.abs(value)}`;

function draw() {
  const frame = report.frames[Number(time.value)], mode = report.modes[chosen];
  const kind = document.querySelector("input[name=kind]:checked").value;
  view.draw(frame, mode, frame[kind][chosen], Number(amount.value), angle);
}

function say() {
  const frame = report.frames[Number(time.value)], mode = report.modes[chosen];
  document.getElementById("clock").textContent = `${frame.time.toFixed(3)} µs`;
  document.getElementById("amount-text").textContent = `${amount.value} nm`;
  document.getElementById("says").textContent =
    `m = ${mode}: grows at ${signed(frame.rates[chosen])}/µs; the worst displacement of 0.1 nm at the start is ${frame.peaks[chosen]} nm now.`
    + (frame.noise ? ` One standard deviation of its thermal noise is ${frame.sigmas[chosen]} nm at most.` : "");
  draw();
}

function setTurning(on) {
  turning = on;
  turn.textContent = on ? "Stop" : "Turn";
  turn.setAttribute("aria-label", on ? "Stop turning" : "Turn");
}

function tick(now) {
  if (turning) {
    angle += (2 * Math.PI * Math.min(100, now - last)) / 1000 / SECONDS_PER_TURN;
    draw();
  }
  last = now;
  requestAnimationFrame(tick);
}

report.modes.forEach((mode, index) => {
  const label = document.createElement("label");
  label.innerHTML = `<input type="radio" name="mode" value="${index}"${index === 0 ? " checked" : ""}> ${mode}&ensp;`;
  label.firstChild.addEventListener("change", () => { chosen = index; say(); });
  document.getElementById("modes").append(label);
});
document.getElementById("noise-kind").hidden = !report.frames[0].noise;
time.max = String(report.frames.length - 1);
time.value = String(report.start);
for (const input of [time, amount, ...document.querySelectorAll("input[name=kind]")]) input.addEventListener("input", say);
turn.addEventListener("click", () => setTurning(!turning));
canvas.addEventListener("pointerdown", (event) => { setTurning(false); canvas.setPointerCapture(event.pointerId); });
canvas.addEventListener("pointermove", (event) => {
  if (!event.buttons) return;
  angle += event.movementX / 120;
  draw();
});
document.getElementById("scale-bar").style.background =
  `linear-gradient(to right, ${[INWARD, NEUTRAL, OUTWARD].map((colour) => `rgb(${colour.join(" ")})`).join(", ")})`;
addEventListener("resize", () => { view.resize(); draw(); });
view.resize();
startTheme(draw);
if (matchMedia("(prefers-reduced-motion: reduce)").matches) setTurning(false);
say();
requestAnimationFrame(tick);
document.documentElement.dataset.ready = "true";
