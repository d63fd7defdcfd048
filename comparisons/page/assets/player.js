// Slider, play button and keys choose the frame; everything else only shows it.

const SECONDS_TO_PLAY = 9;

/** Connect the controls; `show(frame)` draws. Returns {seek(time), current()}. */
function startPlayer(show) {
  const slider = document.getElementById("time");
  const button = document.getElementById("play");
  const last = report.times.length - 1;
  let playing = false, startedAt = 0, startFrame = 0;

  function go(frame) {
    slider.value = String(Math.min(last, Math.max(0, frame)));
    slider.setAttribute("aria-valuetext", `${timeText(current())} µs`);
    show(current());
  }
  const current = () => Number(slider.value);

  function play(on) {
    playing = on && last > 0;
    button.textContent = playing ? "Pause" : "Play";
    button.setAttribute("aria-label", button.textContent);
    if (!playing) return;
    startFrame = current() >= last ? 0 : current();
    startedAt = performance.now();
    requestAnimationFrame(tick);
  }

  function tick(now) {
    if (!playing) return;
    const frame = startFrame + Math.max(0, Math.floor(((now - startedAt) / 1000 / SECONDS_TO_PLAY) * last));
    if (frame !== current()) go(frame);
    if (frame >= last) play(false); else requestAnimationFrame(tick);
  }

  const steps = { ArrowLeft: -1, ArrowRight: 1, ArrowDown: -1, ArrowUp: 1 };
  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    const onSlider = event.target === slider;
    const elsewhere = !onSlider && event.target.closest("button, input, summary, a");
    if (event.key === " " && !elsewhere) {
      play(!playing);
    } else if (event.key in steps && (onSlider || (!elsewhere && event.key.match(/Left|Right/)))) {
      play(false);
      go(current() + steps[event.key] * (event.shiftKey ? 10 : 1));
    } else {
      return;
    }
    event.preventDefault();
  });
  slider.addEventListener("input", () => { play(false); go(current()); });
  button.addEventListener("click", () => play(!playing));

  slider.max = String(last);
  /** Show the frame nearest to a time (µs). */
  function seek(time) {
    let nearest = 0;
    report.times.forEach((t, i) => { if (Math.abs(t - time) < Math.abs(report.times[nearest] - time)) nearest = i; });
    play(false);
    go(nearest);
  }
  return { seek, current };
}
