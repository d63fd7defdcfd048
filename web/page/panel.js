"use strict";
// Sliders of the parameters that matter, and all parameters as the engine's table has them.

function element(kind, attributes = {}, ...children) {
  const made = document.createElement(kind);
  for (const [name, value] of Object.entries(attributes)) {
    if (name in made && typeof value !== "string") made[name] = value;
    else made.setAttribute(name, value);
  }
  made.append(...children);
  return made;
}

/** One row of SLIDERS in the panel; what kinds of it add is how a setting is put in and shown. */
class Control {
  constructor(row, settings, input, ...parts) {
    Object.assign(this, { row, settings, input });
    this.note = element("p", { id: `${input.id}-note` }, row.typical);
    this.element = element("div", { class: "slider" }, ...parts, this.note);
  }

  /** A visitor's value, with what it brings. */
  put(value) {
    const { row, settings } = this, before = settings.get(row.key);
    settings.change(row.key, value);
    for (const [name, other] of Object.entries(row.implies?.(value, settings, before) ?? {})) settings.set(name, other);
  }

  show() {
    const { row, settings } = this, refusal = row.refused?.(settings);
    this.element.hidden = row.when !== undefined && !row.when(settings);
    this.input.disabled = refusal !== undefined;
    this.note.textContent = refusal ?? row.typical;
    this.element.classList.toggle("changed", row.key in settings.values);
  }
}

const controlId = (row) => `slider-${row.key.replace(".", "-")}`;

/** A slider is linear, or logarithmic in a thousand parts. */
class Slider extends Control {
  constructor(row, settings, changed) {
    const id = controlId(row);
    const range = row.log ? { min: "0", max: "1000", step: "1" } : { min: row.from, max: row.to, step: row.step };
    const input = element("input", { type: "range", id, "aria-describedby": `${id}-note`,
      ...Object.fromEntries(Object.entries(range).map(([key, value]) => [key, String(value)])) });
    const output = element("output", { for: id, "aria-live": "off" });
    super(row, settings, input, element("label", { for: id }, row.label), output, input);
    this.output = output;
    input.addEventListener("input", () => {
      this.store();
      this.show();
      changed();
    });
  }

  get shownValue() {
    const value = this.settings.get(this.row.key);
    return this.row.shown ? this.row.shown(value) : value;
  }

  store() {
    const { row } = this, place = Number(this.input.value);
    const shown = row.log ? Number((row.from * (row.to / row.from) ** (place / 1000)).toPrecision(2)) : place;
    this.put(row.meant ? Number(row.meant(shown).toPrecision(9)) : shown);
  }

  /** Moves the handle to the setting, and says its value. */
  show() {
    super.show();
    const { row } = this, shown = this.shownValue;
    if (row.limits) this.narrow(...row.limits(this.settings));
    if (typeof shown === "number" && document.activeElement !== this.input)
      this.input.value = row.log ? (1000 * Math.log(Math.max(shown, row.from) / row.from)) / Math.log(row.to / row.from) : shown;
    const words = typeof shown === "number" && Number.isFinite(shown) ? short(shown) : String(shown);
    this.output.replaceChildren(words, " ", element("small", {}, row.unit));
    this.input.setAttribute("aria-valuetext", `${words} ${row.unit}`);
  }

  /** Leaves the slider its whole steps between two values. */
  narrow(least, most) {
    const { from, to, step } = this.row;
    this.input.min = Math.max(from, step * Math.ceil(least / step));
    this.input.max = Math.min(to, step * Math.floor(most / step));
  }
}

/** One of a few words. */
class Choice extends Control {
  constructor(row, settings, changed) {
    const id = controlId(row);
    const input = element("select", { id, "aria-describedby": `${id}-note` },
      ...Object.entries(row.choices).map(([value, words]) => element("option", { value }, words)));
    super(row, settings, input, element("label", { for: id }, row.label), input);
    input.addEventListener("change", () => {
      this.put(input.value);
      changed();
    });
  }

  show() {
    super.show();
    this.input.value = String(this.settings.get(this.row.key));
  }
}

/** A box: ticked where the setting is not its default. */
class Tick extends Control {
  constructor(row, settings, changed) {
    const id = controlId(row);
    const input = element("input", { type: "checkbox", id, "aria-describedby": `${id}-note` });
    super(row, settings, input, element("label", { class: "check", for: id }, input, row.label));
    input.addEventListener("change", () => {
      this.put(input.checked ? row.ticked(settings) : undefined);
      changed();
    });
  }

  show() {
    super.show();
    this.input.checked = this.row.key in this.settings.values;
  }
}

const controlOf = (row) => (row.choices ? Choice : row.ticked ? Tick : Slider);

/** Sections that this engine does not read. */
const unread = (name) => name.startsWith("phase_field") || name === "boundary_integral.threads";

class Panel {
  constructor(settings, changed) {
    this.settings = settings;
    this.sliders = SLIDERS.filter(({ key }) => settings.table.has(key)).map((row) => new (controlOf(row))(row, settings, () => {
      this.show();
      changed();
    }));
    const groups = new Map();
    for (const slider of this.sliders) {
      const { group } = slider.row;
      if (!groups.has(group)) groups.set(group, element("fieldset", {}, element("legend", {}, group)));
      groups.get(group).append(slider.element);
    }
    document.getElementById("sliders").append(...groups.values());
    this.fields = new Map();
    const sections = new Map();
    for (const row of settings.table.values()) {
      if (unread(row.name)) continue;
      const section = row.name.slice(0, row.name.lastIndexOf("."));
      if (!sections.has(section)) sections.set(section, element("fieldset", {}, element("legend", {}, `[${section}]`)));
      sections.get(section).append(this.field(row, changed));
    }
    document.getElementById("all-parameters").append(...sections.values());
  }

  field(row, changed) {
    const id = `all-${row.name.replaceAll(".", "-")}`;
    const words = row.choices.length ? row.choices : typeof row.default === "boolean" ? ["true", "false"] : null;
    const input = words
      ? element("select", { id, "aria-describedby": `${id}-note` }, ...words.map((word) => element("option", { value: word }, word)))
      : element("input", { id, type: "text", "aria-describedby": `${id}-note`, spellcheck: "false", autocomplete: "off",
        ...(typeof row.default === "number" ? { inputmode: "decimal" } : {}) });
    input.addEventListener("change", () => {
      this.settings.change(row.name, typedValue(input.value, row.default));
      this.show();
      changed();
    });
    this.fields.set(row.name, input);
    const allowed = row.choices.length || !row.allowed ? "" : ` Allowed: ${row.allowed.replaceAll("<=", "≤").replaceAll(">=", "≥")}.`;
    return element("div", { class: "parameter" },
      element("label", { for: id }, row.name.split(".").at(-1), row.unit ? ` (${row.unit})` : ""), input,
      element("p", { id: `${id}-note` }, `${row.meaning}.${allowed}`));
  }

  show() {
    for (const slider of this.sliders) slider.show();
    for (const [name, input] of this.fields)
      if (document.activeElement !== input) input.value = String(this.settings.get(name));
  }
}
