"use strict";
// The laboratory: settings, a run, what is seen of it.

const find = (id) => document.getElementById(id);
const still = matchMedia("(prefers-reduced-motion: reduce)");

/** Shapes that a run keeps: of a long one, every second goes each time there are more. Some 5 kB each. */
const MOST_FRAMES = 1200;

class Laboratory {
  constructor() {
    this.engine = new EngineClient(WORKER, WASM);
    this.engine.onprogress = (said) => this.progress(said);
    this.stage = new Stage(find("stage"));
    this.charts = [new Chart(find("neck"), "neck", "Neck radius", "nm"), new Chart(find("height"), "height", "Height", "nm"),
      new Chart(find("energy"), "energy", "Bending energy", "pN nm"), new Chart(find("maturity"), "maturity", "Maturity χ", "parts of 1")];
    this.run = this.emptyRun(0);
    this.kept = null;
    this.pictures = 0;  // drawn since the page was opened
    this.enter("loading");
  }

  emptyRun(id) { return { id, rows: [], frames: [], events: {}, warnings: [], time: 0, seconds: 0, memory: 0 }; }

  async open() {
    const said = await this.engine.loaded;
    if (said.error) return this.fail(`the engine did not start: ${said.error}; a browser of 2023 or later is needed`);
    this.version = `${said.version} (${said.git})`;
    find("version").textContent = `endoflow ${this.version}.`;
    this.settings = new Settings(said.parameters);
    this.panel = new Panel(this.settings, () => this.startSoon());
    this.tour = new Tour(this);
    this.wire();
    await this.fromAddress();
    await this.readPresets();
  }

  /** What each case sets, as the engine reads it. */
  async readPresets() {
    for (const preset of PRESETS) {
      const sections = await this.engine.ask("check", { text: preset.text });
      const settings = new Settings([...this.settings.table.values()]);
      settings.take(sections);
      delete settings.values["case.description"];
      preset.values = settings.values;
    }
    this.presetsRead = true;
    this.namePreset();
  }

  caseText() { return caseFile(this.settings, this.version); }

  /** Which case the settings are, if any. */
  namePreset() {
    const named = (values) => JSON.stringify(Object.entries(values).sort());
    const same = PRESETS.find(({ values }) => values && named(values) === named(this.settings.values));
    find("preset").value = same?.name ?? "";
  }

  wire() {
    const on = (id, work, event = "click") => find(id).addEventListener(event, work);
    on("stop", () => (this.state === "running" ? this.stop() : this.resume()));
    on("restart", () => this.start());
    on("replay", () => this.replay());
    on("when", () => { this.replaying = null; this.shown = Number(find("when").value); this.redraw(); }, "input");
    on("arrows", () => { this.showArrows(find("arrows").checked); }, "change");
    on("keep", () => { this.kept = this.keepable(this.words()); this.redraw(); });
    on("forget", () => { this.kept = null; this.redraw(); find("keep").focus(); });
    on("preset", () => this.preset(find("preset").value), "change");
    on("link", () => this.copyLink());
    on("save-case", () => save("case.toml", this.caseText(), "application/toml"));
    on("save-history", async () => save("history.csv", await this.engine.ask("history"), "text/csv"));
    on("save-picture", () => find("stage").toBlob((blob) => save("membrane.png", blob)));
    on("save-film", () => this.film());
    find("save-film").hidden = !filmType();
    find("preset").append(element("option", { value: "" }, "own settings"), ...PRESETS.map(({ name, title }) => element("option", { value: name }, title)));
    addEventListener("hashchange", () => { if (location.hash.slice(1) !== this.settings.toHash()) this.fromAddress(); });
    addEventListener("resize", () => this.redraw());
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.redraw());
    const view = document.querySelector(".view");
    new ResizeObserver(() => document.documentElement.style.setProperty("--view-height", `${view.offsetHeight}px`)).observe(view);
    find("stage").addEventListener("keydown", (event) => this.step(event));
  }

  async fromAddress() {
    const unknown = this.settings.fromHash(location.hash);
    await this.start();
    if (unknown.length) this.say(`the link names what is no parameter: ${unknown.join(", ")}; the rest of it is set`);
  }

  async preset(name) {
    const found = PRESETS.find((preset) => preset.name === name);
    if (!found?.values) return;
    this.settings.values = { ...found.values };
    await this.start();
  }

  startSoon() {
    clearTimeout(this.soon);
    this.soon = setTimeout(() => this.start(), 180);
  }

  async start() {
    clearTimeout(this.soon);
    this.panel.show();
    history.replaceState(null, "", `#${this.settings.toHash()}`);
    this.namePreset();
    this.run = { ...this.emptyRun(this.run.id + 1), values: { ...this.settings.values } };
    this.replaying = null;
    this.shown = undefined;
    this.enter("running");
    find("error").hidden = true;
    const said = await this.engine.ask("start", { text: this.settings.toToml(), id: this.run.id });
    if (said.error) this.fail(said.error);
  }

  /** A run that ends before the worker hears of it has ended, not stopped. */
  async stop() {
    const { id } = this.run;
    if (await this.engine.ask("stop") === id && this.run.id === id) this.enter("stopped");
  }

  async resume() {
    this.shown = undefined;
    this.replaying = null;
    this.enter("running");
    await this.engine.ask("resume", { id: this.run.id });
  }

  progress(said) {
    const run = this.run;
    if (said.run !== run.id) return;
    for (const [time, neck, height, energy, maturity] of said.rows) run.rows.push({ time, neck, height, energy, maturity });
    run.time = said.time_us ?? run.time;
    if (said.shape) run.frames.push(new Frame(run.time, said.shape));
    if (run.frames.length > MOST_FRAMES) this.thin(run);
    run.events = said.events ?? run.events;
    run.seconds += said.seconds ?? 0;
    run.memory = said.memory ?? run.memory;
    run.warnings.push(...said.warnings);
    if (said.ended) {
      run.ended = said.ended;
      this.enter("ended");
    } else if (said.error) {
      this.fail(said.error);
    } else if (said.paused) {
      this.enter("stopped");
    }
    this.redraw();
  }

  /** Leaves out every second shape, but not the last one. */
  thin(run) {
    const last = run.frames.length - 1;
    run.frames = run.frames.filter((_, i) => i % 2 === 0 || i === last);
    if (this.shown !== undefined) this.shown = Math.floor(this.shown / 2);
  }

  say(message) {
    find("error").textContent = message;
    find("error").hidden = false;
  }

  fail(message) {
    this.say(message);
    this.enter("failed");
  }

  /** States: loading, running, stopped, ended, failed. */
  enter(state) {
    this.state = state;
    const stop = find("stop");
    stop.textContent = state === "stopped" ? "Continue" : "Stop";
    stop.disabled = state !== "running" && state !== "stopped";
    find("replay").disabled = state === "running" || this.run.frames.length < 2;
    find("keep").disabled = this.run.frames.length < 2 && state !== "running";
    this.redraw();
    if (state !== "running" && this.run.rows.length) for (const chart of this.charts) chart.describe(this.run.rows);
  }

  /** The large line: one of a few sentences, so that a screen reader hears each of them once. */
  verdict() {
    const budding = this.run.events.budding?.time_us;
    if (budding !== undefined) return ["Buds after ", `${Number(budding.toPrecision(4))} µs`];
    if (this.state === "loading") return ["Loading the engine"];
    if (this.state === "failed") return [this.run.rows.length ? "Stopped by an error" : "These settings cannot run"];
    if (this.state === "ended" && this.run.ended === "neck-closed") return ["The neck closed after ", `${short(this.run.time)} µs`];
    if (this.state === "ended") return ["No bud until ", `${short(this.run.time)} µs`];
    if (this.state === "stopped") return ["Stopped"];
    return ["Computing …"];
  }

  redraw() {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => {
      this.waiting = false;
      this.draw();
    });
  }

  draw() {
    const { run } = this, [words, number] = this.verdict();
    if (find("verdict").textContent !== words + (number ?? ""))
      find("verdict").replaceChildren(words, ...(number ? [element("span", { class: "number" }, number)] : []));
    const slider = find("when"), last = run.frames.length - 1;
    const shown = Math.max(0, Math.min(this.shown ?? last, last)), frame = run.frames[shown];
    slider.max = Math.max(last, 0);
    slider.value = shown;
    slider.setAttribute("aria-valuetext", frame ? `${short(frame.time)} microseconds` : "nothing yet");
    find("clock").textContent = frame ? `t = ${frame.time.toPrecision(4)} µs` : "";
    if (!(still.matches && this.state === "running" && last > 0)) {
      const old = this.kept && frame && this.kept.frames.findLast(({ time }) => time <= frame.time * (1 + 1e-9));
      this.stage.draw(frame, old);
      if (frame) this.stage.canvas.setAttribute("aria-label", this.picture(frame));
    }
    const matures = [run, this.kept].some((seen) => seen?.rows[0]?.maturity < 1);
    find("maturity").parentElement.hidden = !matures;
    document.querySelector(".curves").classList.toggle("four", matures);
    if (this.state !== "running" || this.pictures % 4 === 0)  // curves grow by less than what is seen at once
      for (const chart of this.charts.slice(0, matures ? 4 : 3)) chart.draw(run, this.kept, this.shown === undefined ? undefined : frame?.time);
    find("warnings").hidden = run.warnings.length === 0;
    if (find("warnings").childElementCount !== run.warnings.length)
      find("warnings").replaceChildren(...run.warnings.map((text) => element("li", {}, text)));
    find("forget").hidden = find("kept").hidden = !this.kept;
    find("kept").textContent = this.kept ? `Dashed: ${this.kept.label}${this.kept.events.budding ? `, buds after ${short(this.kept.events.budding.time_us)} µs` : ""}.` : "";
    this.pictures += 1;
  }

  picture(frame) {
    const { low, high } = frame.bounds();
    return `Meridian of the membrane at ${short(frame.time)} microseconds, ${short(high - low)} nm high, coloured by the coat. Left and right arrows change the time.`;
  }

  showArrows(on) {
    this.stage.arrows = on;
    find("arrows").checked = on;
    this.redraw();
  }

  words() {
    const own = Object.entries(this.settings.values).filter(([name]) => !name.startsWith("case."));
    return own.length ? own.map(([name, value]) => `${name.split(".").at(-1)} = ${value}`).join(", ") : "the standard case";
  }

  keepable(label) {
    return { label, rows: this.run.rows, frames: this.run.frames, events: this.run.events };
  }

  step(event) {
    const way = { ArrowLeft: -1, ArrowRight: 1, Home: -Infinity, End: Infinity }[event.key];
    if (way === undefined) return;
    event.preventDefault();
    const last = this.run.frames.length - 1;
    this.replaying = null;
    this.shown = Math.max(0, Math.min(last, (this.shown ?? last) + way));
    this.redraw();
  }

  /** Shows the run again within some seconds; resolves when it has ended. */
  replay(seconds = 5) {
    const { frames } = this.run, turn = (this.replaying = {}), end = frames.at(-1)?.time ?? 0;
    const begin = performance.now();
    return new Promise((resolve) => {
      const next = () => {
        const part = (performance.now() - begin) / 1e3 / seconds;
        if (this.replaying !== turn || part >= 1) {
          if (this.replaying === turn) this.shown = undefined;
          this.redraw();
          return resolve();
        }
        const after = frames.findIndex(({ time }) => time > part * end);
        this.shown = Math.max(0, after - 1);
        this.draw();
        requestAnimationFrame(next);
      };
      next();
    });
  }

  async film() {
    const note = find("files-note");
    find("save-film").disabled = true;
    note.textContent = "Filming: the run is played once.";
    const blob = await film(find("stage"), () => this.replay());
    save("membrane.webm", blob);
    note.textContent = `membrane.webm, ${Math.round(blob.size / 1024)} kB`;
    find("save-film").disabled = false;
  }

  async copyLink() {
    try {
      await navigator.clipboard.writeText(location.href);
      find("files-note").textContent = "The link with all settings is in the clipboard.";
    } catch {
      find("files-note").textContent = `The link with all settings: ${location.href}`;
    }
  }
}

window.laboratory = new Laboratory();
window.laboratory.open();
