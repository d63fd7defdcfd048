"use strict";
// Settings: what differs from the defaults, as {"section.key": value}; case files and links are made from them.

const FORCE = "membrane.coat_force", RING = "membrane.coat_force_ring";
const RATE = "molecules.maturation_rate", START = "molecules.maturation_start";

/** Rate [1/µs] of a maturation that is chosen and has none yet: a coat's curvature is there after some µs. */
const FIRST_RATE = 0.5;

/** Least width of a ring [nm], as the case's checks have it, and some more for round-off. */
const RING_WIDTH = 2.1;

const rounded = (length) => Math.round(10 * length) / 10;
const hasRing = (settings) => Number(settings.get(RING)?.[1]) > 0;
const matures = (settings) => settings.get("molecules.maturation") !== "none";

/** Material radii of a ring between coat and rim, divided as in cases/actin.toml. */
function ringAround(settings) {
  const edge = settings.get("molecules.patch_radius"), rim = settings.get("domain.radius"), room = rim - edge;
  const outer = Math.min(rim, Math.max(rounded(edge + (3 * room) / 7), RING_WIDTH));
  return [Math.max(0, Math.min(rounded(edge + room / 7), rounded(outer - RING_WIDTH))), outer];
}

/** Coat radii [nm] between which a case has a patch inside of its box, and of less than the pool's area. */
function coatRadii(settings) {
  if (settings.get("domain.kind") !== "box") return [0, Infinity];
  const width = settings.get("molecules.interface_width"), pool = settings.get("molecules.pool_area");
  const edge = 1.56 * width;  // c is 0.1 there
  const inPool = pool > 0 ? Math.sqrt(Math.max(0, pool / Math.PI - (Math.PI * width) ** 2 / 6)) : Infinity;
  return [edge, Math.min(settings.get("domain.radius") - edge, inPool - 1e-3)];
}

/** Why a case bears no loads. */
function withoutLoads(settings) {
  if (settings.get("domain.kind") !== "box") return "not for a membrane in free space";
  if (settings.get("fluid.dynamics") !== "flow") return "not without the fluids’ flow";
  return settings.get("membrane.inextensible") ? undefined : "not for a membrane that stretches";
}

/** Why a coat cannot grow at its edge. */
function withoutGrowth(settings) {
  if (settings.get("domain.kind") !== "box") return "not for a membrane in free space";
  if (settings.get("molecules.transport") === "fickian") return "not where molecules diffuse: they keep no edge";
  return settings.get("molecules.exchange") === "reservoir" ? "not beside molecules.exchange = reservoir" : undefined;
}

/**
 * The parameters that matter, with the range of their slider and a typical value with its source in words. A row with
 * `choices` is a list, one with `ticked` a box that sets what this gives.
 *   limits   the range where other settings narrow it
 *   implies  other settings that a new value brings
 *   when     whether it is shown
 *   refused  why it cannot be moved
 */
const SLIDERS = [
  { group: "The coat", key: "molecules.patch_radius", label: "Coat radius", unit: "nm", from: 12, to: 60, step: 1,
    limits: coatRadii, typical: "a clathrin coat has 30 to 60 nm" },
  { group: "The coat", key: "membrane.spontaneous_curvature", label: "Preferred radius 1/H₀", unit: "nm", from: 8, to: 60, step: 0.1,
    shown: (value) => 1 / value, meant: (shown) => 1 / shown, typical: "the paper: 14.1 nm; small is strongly curved" },
  { group: "The coat", key: "membrane.bending_stiffness_coated", label: "Stiffness, coated", unit: "pN nm", from: 100, to: 4000, log: true,
    typical: "clathrin: 10 to 15 times the bare membrane" },
  { group: "The coat", key: "molecules.edge_speed", label: "Coat growth", unit: "nm/µs", from: 0, to: 10, step: 0.1, refused: withoutGrowth,
    implies: (value) => (value > 0 ? { "molecules.exchange": "edge" } : { "molecules.exchange": undefined, "molecules.pool_area": undefined }),
    typical: "0 is a ready-made coat; cells: 10⁻⁶ nm/µs" },
  { group: "The coat", key: "molecules.maturation", label: "Maturation",
    choices: { none: "no", exponential: "exponentially", cooperative: "cooperatively" },
    implies: (value, settings) => (value === "none" ? { [RATE]: undefined, [START]: undefined }
      : settings.get(RATE) === 0 && settings.get(START) === 0 ? { [RATE]: FIRST_RATE } : {}),
    typical: "how the curvature comes; clathrin is flat at first" },
  { group: "The coat", key: RATE, label: "Maturation rate", unit: "1/µs", from: 0.01, to: 100, log: true, when: matures,
    typical: "cells: 10⁻⁷/µs and less" },
  { group: "The coat", key: START, label: "Curvature at the start", unit: "of H₀", from: 0, to: 1, step: 0.05, when: matures,
    implies: (value, settings) => (value === 0 && settings.get(RATE) === 0 ? { [RATE]: FIRST_RATE } : {}),
    typical: "0 is a flat coat" },
  { group: "The membrane", key: "membrane.bending_stiffness", label: "Stiffness, bare", unit: "pN nm", from: 20, to: 1000, log: true,
    typical: "lipid membranes: 50 to 200 pN nm" },
  { group: "The membrane", key: "membrane.rim_tension", label: "Tension", unit: "pN/nm", from: 0, to: 2, step: 0.01, refused: withoutLoads,
    typical: "cells: 0.003 to 0.3 pN/nm" },
  { group: "The fluids", key: "fluid.viscosity_extracellular", label: "Viscosity outside", unit: "mPa s", from: 0.1, to: 1000, log: true,
    shown: (value) => value * 1e3, meant: (shown) => shown / 1e3, typical: "water: 1 mPa s" },
  { group: "The fluids", key: "fluid.viscosity_intracellular", label: "Viscosity inside", unit: "mPa s", from: 0.1, to: 1000, log: true,
    shown: (value) => value * 1e3, meant: (shown) => shown / 1e3, typical: "cytosol: 2 to 10 mPa s and more" },
  { group: "Forces", key: "fluid.pressure_difference", label: "Pressure, outside − inside", unit: "kPa", from: -20, to: 20, step: 0.5,
    shown: (value) => value * 1e3, meant: (shown) => shown / 1e3, refused: withoutLoads, typical: "turgor of yeast: −200 to −1000 kPa" },
  { group: "Forces", key: "membrane.pole_force", label: "Pole force", unit: "pN", from: -200, to: 500, step: 10, refused: withoutLoads,
    typical: "an actin filament: 1 to 5 pN" },
  { group: "Forces", key: FORCE, label: "Actin’s force on the coat", unit: "pN", from: 0, to: 200, step: 5, refused: withoutLoads,
    implies: (value, settings, before) => (before === 0 && value !== 0 ? { [RING]: ringAround(settings) } : {}),
    typical: "at a pit: 10 to 20 pN, over 100 at high tension" },
  { group: "Forces", key: RING, label: "It stands on a ring around the coat", ticked: ringAround, when: (settings) => settings.get(FORCE) !== 0,
    typical: "else the membrane’s rim bears the force" },
  { group: "Forces", key: "membrane.collar_force", label: "Collar’s force on the neck", unit: "pN", from: -100, to: 100, step: 5, refused: withoutLoads,
    implies: (value) => (value === 0 ? { "membrane.collar_position": undefined } : {}),
    typical: "narrows the neck once it is 10 nm wide; < 0 holds it open" },
  { group: "The run", key: "time.end", label: "Ends at", unit: "µs", from: 0.05, to: 100, log: true,
    typical: "the standard coat buds after 0.83 µs" },
];

class Settings {
  /** `parameters`: the engine's table. */
  constructor(parameters) {
    this.table = new Map(parameters.map((row) => [row.name, row]));
    this.values = {};
  }

  get(name) { return this.values[name] ?? this.table.get(name).default; }

  /** A value that is the default is no setting. */
  set(name, value) {
    if (value === undefined || String(value) === String(this.table.get(name)?.default)) delete this.values[name];
    else this.values[name] = value;
  }

  /** As a visitor sets it: a ring that bears a force on the coat goes with the coat and the box, and with the force. */
  change(name, value) {
    this.set(name, value);
    if (!hasRing(this)) return;
    if (name === FORCE && value === 0) this.set(RING, undefined);
    const followed = name === "molecules.patch_radius" || name === "domain.radius";
    if (followed && ringAround(this).every(Number.isFinite)) this.set(RING, ringAround(this));
  }

  /** From all parameters of a case as the engine reads it: {section: {key: value}}. */
  take(sections) {
    this.values = {};
    for (const row of this.table.values()) {
      const value = row.name.split(".").reduce((node, part) => node?.[part], sections);
      if (value !== undefined) this.set(row.name, value);
    }
  }

  toToml() {
    const sections = new Map();
    for (const [name, value] of Object.entries(this.values)) {
      const dot = name.lastIndexOf("."), section = name.slice(0, dot);
      if (!sections.has(section)) sections.set(section, []);
      sections.get(section).push(`${name.slice(dot + 1)} = ${tomlValue(value, this.table.get(name)?.default)}`);
    }
    return [...sections].map(([section, lines]) => `[${section}]\n${lines.join("\n")}\n`).join("\n");
  }

  toHash() {
    return Object.entries(this.values).map(([name, value]) => `${name}=${encodeURIComponent(value)}`).join("&");
  }

  /** From a link's hash; values are what their parameter's default is. Says what it does not know. */
  fromHash(hash) {
    this.values = {};
    const unknown = [];
    for (const part of hash.replace(/^#/, "").split("&").filter(Boolean)) {
      const equals = part.indexOf("="), name = part.slice(0, equals);
      if (equals < 0 || !this.table.has(name)) unknown.push(part);
      else this.set(name, typedValue(decoded(part.slice(equals + 1)), this.table.get(name).default));
    }
    return unknown;
  }
}

function decoded(text) {
  try {
    return decodeURIComponent(text);
  } catch {
    return text;
  }
}

/** What a person typed, as a value of the parameter's kind where it can be one; else the text, which the engine refuses. */
function typedValue(text, kin) {
  if (typeof kin === "boolean") return text === "true" ? true : text === "false" ? false : text;
  if (Array.isArray(kin)) {
    const numbers = text.replace(/[[\]]/g, "").split(",").map((part) => (part.trim() === "" ? NaN : Number(part)));
    return numbers.length === kin.length && numbers.every(Number.isFinite) ? numbers : text;
  }
  if (typeof kin === "number" && text.trim() !== "" && Number.isFinite(Number(text))) return Number(text);
  return text;
}

function tomlValue(value, kin) {
  if (Array.isArray(value)) return `[${value.join(", ")}]`;
  if (typeof value === "number") return Number.isInteger(kin) || !Number.isInteger(value) ? String(value) : value.toFixed(0);
  return typeof value === "string" ? JSON.stringify(value) : String(value);
}
