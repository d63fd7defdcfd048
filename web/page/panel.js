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

/** A slider is linear, or logarithmic in a thousand parts. */
class Slider {
  constructor(row, settings, changed) {
    Object.assign(this, { row, settings });
    const id = `slider-${row.key.replace(".", "-")}`;
    const range = row.log ? { min: "0", max: "1000", step: "1" } : { min: row.from, max: row.to, step: row.step };
    this.input = element("input", { type: "range", id, "aria-describedby": `${id}-note`,
      ...Object.fromEntries(Object.entries(range).map(([key, value]) => [key, String(value)])) });
    this.output = element("output", { for: id, "aria-live": "off" });
    this.element = element("div", { class: "slider" }, element("label", { for: id }, row.label), this.output, this.input,
      element("p", { id: `${id}-note` }, row.typical));
    this.input.addEventListener("input", () => {
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
    const value = row.meant ? Number(row.meant(shown).toPrecision(9)) : shown;
    this.settings.set(row.key, value);
    for (const [name, other] of Object.entries(row.implies?.(value) ?? {})) this.settings.set(name, other);
  }

  /** Moves the handle to the setting, and says its value. */
  show() {
    const { row } = this, shown = this.shownValue;
    if (typeof shown === "number" && document.activeElement !== this.input)
      this.input.value = row.log ? (1000 * Math.log(shown / row.from)) / Math.log(row.to / row.from) : shown;
    const words = typeof shown === "number" && Number.isFinite(shown) ? short(shown) : String(shown);
    this.output.replaceChildren(words, " ", element("small", {}, row.unit));
    this.input.setAttribute("aria-valuetext", `${words} ${row.unit}`);
    this.element.classList.toggle("changed", row.key in this.settings.values);
  }
}

/** Sections that this engine does not read. */
const unread = (name) => name.startsWith("phase_field") || name === "boundary_integral.threads";

class Panel {
  constructor(settings, changed) {
    this.settings = settings;
    this.sliders = SLIDERS.map((row) => new Slider(row, settings, () => {
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
      this.settings.set(row.name, typedValue(input.value, row.default));
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
