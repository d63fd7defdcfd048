// Draws both membranes at one frame: run A in the left half-plane, run B in the right one, coloured by c.

/** A view on `canvas`; returns {draw(frame, {outlines, arrows}), resize()}. */
function membraneView(canvas) {
  const context = canvas.getContext("2d");
  const margin = { left: 58, right: 14, top: 8, bottom: 44 };
  const [lowest, highest] = report.heightRange;
  let scale = 1;  // CSS pixels per nm
  let centre = 0;  // x of the axis
  let colours = {};

  function resize() {
    const width = canvas.clientWidth;
    const byWidth = (width - margin.left - margin.right) / (2 * report.rim);
    const byHeight = Math.max(300, 0.55 * window.innerHeight) / (highest - lowest);
    scale = Math.min(byWidth, byHeight);
    centre = margin.left + (width - margin.left - margin.right) / 2;
    const height = Math.round(scale * (highest - lowest) + margin.top + margin.bottom);
    const ratio = window.devicePixelRatio || 1;
    canvas.style.height = `${height}px`;
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    colours = { concentration: concentrationColours() };
    for (const name of ["extracellular", "cytoplasm", "axis", "ink", "muted", "run-a", "run-b", "grid"]) {
      colours[name] = themed(`--${name}`);
    }
  }

  const toX = (r) => centre + scale * r;
  const toY = (z) => margin.top + scale * (highest - z);

  /** Trace points first…last of a run's curve at a frame; side −1 mirrors it. */
  function trace(run, frame, side, first, last) {
    const start = frame * report.points;
    for (let i = first; i <= last; ++i) {
      const x = toX(side * run.r[start + i]);
      const y = toY(run.z[start + i]);
      if (i === first) context.moveTo(x, y); else context.lineTo(x, y);
    }
  }

  function tintExtracellular(run, frame, side) {
    context.beginPath();
    trace(run, frame, side, 0, report.points - 1);
    context.lineTo(toX(side * run.r[(frame + 1) * report.points - 1]), toY(lowest));  // the rim, or the axis below a vesicle
    context.lineTo(toX(0), toY(lowest));
    context.fillStyle = colours.extracellular;
    context.fill();
  }

  function drawMembrane(run, frame, side) {
    const start = frame * report.points;
    const level = (i) => Math.round(COLOUR_LEVELS * Math.min(1, Math.max(0, (run.c[start + i] + run.c[start + i + 1]) / 2)));
    context.lineWidth = Math.max(3, 0.75 * scale);
    context.lineCap = context.lineJoin = "round";
    let first = 0;
    for (let i = 1; i <= report.points - 1; ++i) {
      if (i < report.points - 1 && level(i) === level(first)) continue;
      context.beginPath();
      trace(run, frame, side, first, i);
      context.strokeStyle = colours.concentration[level(first)];
      context.stroke();
      first = i;
    }
  }

  function drawOutline(run, frame, side, colour) {
    context.beginPath();
    trace(run, frame, side, 0, report.points - 1);
    context.setLineDash([6, 5]);
    context.lineWidth = 1.5;
    context.strokeStyle = colour;
    context.stroke();
    context.setLineDash([]);
  }

  /** Velocities as arrows from the membrane; their lengths are logarithmic, see report.arrows. */
  function drawArrows(run, frame, side) {
    const { stride, slowest, fastest, longest } = report.arrows;
    const count = Math.ceil(report.points / stride);
    context.strokeStyle = context.fillStyle = colours.ink;
    context.lineWidth = 1.6;
    for (let i = 0; i < count; ++i) {
      const u = side * run.u_r[frame * count + i], w = run.u_z[frame * count + i];
      const speed = Math.hypot(u, w);
      if (!(speed > slowest)) continue;
      const length = (scale * longest * Math.log(speed / slowest)) / Math.log(fastest / slowest);
      const point = frame * report.points + i * stride;
      drawArrow(toX(side * run.r[point]), toY(run.z[point]), (u / speed) * length, (-w / speed) * length);
    }
  }

  function drawArrow(x, y, dx, dy) {
    const length = Math.hypot(dx, dy), head = Math.min(7, 0.6 * length);
    const [ex, ey] = [dx / length, dy / length];
    context.beginPath(); context.moveTo(x, y); context.lineTo(x + dx - ex * head, y + dy - ey * head); context.stroke();
    context.beginPath();
    context.moveTo(x + dx, y + dy);
    context.lineTo(x + dx - head * (ex + 0.4 * ey), y + dy - head * (ey - 0.4 * ex));
    context.lineTo(x + dx - head * (ex - 0.4 * ey), y + dy - head * (ey + 0.4 * ex));
    context.fill();
  }

  function drawAxes() {
    context.strokeStyle = colours.axis;
    context.fillStyle = colours.muted;
    context.lineWidth = 1;
    context.font = "13px system-ui, 'DejaVu Sans', sans-serif";
    context.textAlign = "center";
    context.textBaseline = "top";
    const bottom = toY(lowest);
    for (let r = -report.rim; r <= report.rim + 1e-9; r += 20) {
      context.beginPath(); context.moveTo(toX(r), bottom + 4); context.lineTo(toX(r), bottom + 9); context.stroke();
      context.fillText(Math.abs(r).toFixed(0), toX(r), bottom + 11);
    }
    context.fillText("r (nm)", toX(0), bottom + 27);
    context.textAlign = "right";
    context.textBaseline = "middle";
    for (let z = Math.ceil(lowest / 20) * 20; z <= highest; z += 20) {
      context.beginPath(); context.moveTo(toX(-report.rim) - 5, toY(z)); context.lineTo(toX(-report.rim), toY(z)); context.stroke();
      context.fillText(z.toFixed(0), toX(-report.rim) - 8, toY(z));
    }
    context.save();
    context.translate(toX(-report.rim) - 46, (toY(lowest) + toY(highest)) / 2);
    context.rotate(-Math.PI / 2);
    context.textAlign = "center";
    context.fillText("z (nm)", 0, 0);
    context.restore();
    context.setLineDash([8, 4, 2, 4]);
    context.beginPath(); context.moveTo(toX(0), toY(highest)); context.lineTo(toX(0), bottom); context.stroke();
    context.setLineDash([]);
    for (const [side, colour] of [[-1, colours["run-a"]], [1, colours["run-b"]]]) {
      context.fillStyle = colour;
      context.fillRect(Math.min(toX(side * report.rim), toX(0) + 2 * side), bottom, report.rim * scale - 2, 4);
    }
  }

  function nameFluids() {
    if (report.closed) return;  // which fluid a vesicle holds is up to its case
    context.fillStyle = colours.muted;
    context.font = "13px system-ui, 'DejaVu Sans', sans-serif";
    context.textAlign = "left";
    context.textBaseline = "middle";
    context.fillText("cell interior", toX(-report.rim) + 12, toY(highest) + 18);
    context.fillText("extracellular fluid", toX(-report.rim) + 12, toY(lowest + 3.5));
  }

  function draw(frame, shown) {
    context.clearRect(0, 0, canvas.clientWidth, canvas.clientHeight);
    context.fillStyle = colours.cytoplasm;
    context.fillRect(toX(-report.rim), toY(highest), 2 * report.rim * scale, (highest - lowest) * scale);
    report.runs.forEach((run, index) => {
      const side = index === 0 ? -1 : 1;
      context.save();
      context.beginPath();
      context.rect(Math.min(toX(0), toX(side * report.rim)), 0, report.rim * scale, toY(lowest));
      context.clip();
      tintExtracellular(run, frame, side);
      drawMembrane(run, frame, side);
      if (shown.outlines) drawOutline(report.runs[1 - index], frame, side, index === 0 ? colours["run-b"] : colours["run-a"]);
      if (shown.arrows) drawArrows(run, frame, side);
      context.restore();
    });
    drawAxes();
    nameFluids();
  }

  return { draw, resize };
}
