"use strict";
// Six steps, each of which sets the laboratory and runs it. `keep`: the curve before stays in sight.

const TOUR = [
  { title: "What the coat does",
    text: "The coat, drawn in orange, wants to be curved; the bare membrane wants to be flat. It bends the membrane into the cell, against the viscosity of both fluids. After less than a microsecond there is a bud.",
    values: {} },
  { title: "The neck",
    text: "Watch the top curve: the opening of the bud, its neck, gets narrower ever more slowly, for the fluid in it must be pressed out through a closing hole. We say that the bud has budded when the neck's radius is 5 nm. Switch the velocity on to see the membrane stream.",
    values: {}, arrows: true },
  { title: "Viscosity only sets the clock",
    text: "Both fluids are ten times as viscous now. The shapes are the same, one after the other; only everything takes ten times as long. The dashed curve is the run before.",
    values: { "fluid.viscosity_extracellular": 0.01, "fluid.viscosity_intracellular": 0.1, "time.end": 200 }, keep: true },
  { title: "Tension resists",
    text: "A bud needs membrane, which must be pulled in from the rim. Where the rim holds it with a tension, that costs work: budding is slower, and beyond some tension there is a dome and no bud.",
    values: { "membrane.rim_tension": 1 }, keep: "standard" },
  { title: "Small and large coats",
    text: "A coat of 22 nm is too small to close: it comes to rest as a dome with an open neck, a stationary shape. Move the first slider to find the smallest coat that buds.",
    values: { "molecules.patch_radius": 22, "time.end": 10 }, keep: "standard" },
  { title: "Flow makes the neck wait",
    text: "Without the fluid, each point of the membrane just moves down the gradient of its energy. The neck snaps shut. With the fluid it must wait for the water to get out: the flow, not the energy, sets the pace at the end.",
    values: { "fluid.dynamics": "geometric" }, keep: "standard" },
];

class Tour {
  constructor(laboratory) {
    this.laboratory = laboratory;
    this.place = -1;
    this.standard = null;
    const on = (id, work) => document.getElementById(id).addEventListener("click", work);
    on("tour-open", () => this.go(0));
    on("tour-next", () => (this.place + 1 < TOUR.length ? this.go(this.place + 1) : this.close()));
    on("tour-back", () => this.go(this.place - 1));
    on("tour-close", () => this.close());
  }

  async go(place) {
    const step = TOUR[place], last = place + 1 === TOUR.length;
    this.remember();
    this.place = place;
    document.getElementById("tour").hidden = false;
    document.body.classList.add("touring");
    document.getElementById("tour-place").textContent = `Step ${place + 1} of ${TOUR.length}`;
    document.getElementById("tour-title").textContent = step.title;
    document.getElementById("tour-text").textContent = step.text;
    document.getElementById("tour-back").disabled = place === 0;
    document.getElementById("tour-next").textContent = last ? "Finish" : "Next";
    document.getElementById("tour-title").focus();
    if (step.arrows !== undefined) this.laboratory.showArrows(step.arrows);
    this.laboratory.kept = step.keep ? this.standard : null;
    this.laboratory.settings.values = { ...step.values };
    await this.laboratory.start();
  }

  /** The standard case's run, which later steps are laid beside. */
  remember() {
    if (Object.keys(this.laboratory.settings.values).length === 0 && this.laboratory.run.rows.length > 1)
      this.standard = this.laboratory.keepable("the standard case");
  }

  close() {
    document.getElementById("tour").hidden = true;
    document.body.classList.remove("touring");
    this.place = -1;
    document.getElementById("tour-open").focus();
  }
}
