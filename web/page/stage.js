"use strict";
// The membrane: a meridian and its mirror image, coloured by the coat, between the two fluids.

const css = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
const theme = () => Object.fromEntries(
  ["panel", "ink", "muted", "line", "grid", "outside", "inside", "bare", "coated", "accent", "kept"].map((name) => [name, css(`--${name}`)]));

/** A canvas's context in CSS pixels, at the screen's own resolution. */
function fitted(canvas) {
  const ratio = Math.min(window.devicePixelRatio || 1, 2);
  const { clientWidth: width, clientHeight: height } = canvas;
  if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) {
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
  }
  const context = canvas.getContext("2d");
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  context.clearRect(0, 0, width, height);
  return { context, width, height };
}

function rgb(colour) {
  const hex = colour.replace("#", "");
  return [0, 2, 4].map((i) => parseInt(hex.slice(i, i + 2), 16));
}

function mixed(from, to, part) {
  return `rgb(${from.map((x, i) => Math.round(x + (to[i] - x) * Math.min(1, Math.max(0, part)))).join(" ")})`;
}

/** A recorded shape: numbers r, z, c, u_r, u_z of n points, one list after the other. */
class Frame {
  constructor(time, numbers) {
    this.time = time;
    this.count = numbers.length / 5;
    this.numbers = numbers;
  }
  r(i) { return this.numbers[i]; }
  z(i) { return this.numbers[this.count + i]; }
  c(i) { return this.numbers[2 * this.count + i]; }
  u(i) { return [this.numbers[3 * this.count + i], this.numbers[4 * this.count + i]]; }
  closed() { return this.r(this.count - 1) < 1e-6; }

  bounds() {
    let low = Infinity, high = -Infinity, wide = 0;
    for (let i = 0; i < this.count; ++i) {
      low = Math.min(low, this.z(i));
      high = Math.max(high, this.z(i));
      wide = Math.max(wide, this.r(i));
    }
    return { low, high, wide };
  }
}

class Stage {
  constructor(canvas) {
    this.canvas = canvas;
    this.arrows = false;
  }

  /** Which part of the meridian is seen: the whole width, more only where the membrane needs it. */
  view(frame, width, height) {
    const { low, high, wide } = frame.bounds();
    const scale = Math.min(width / (2 * wide * (frame.closed() ? 1.5 : 1)), (0.74 * height) / Math.max(high - low, 1));
    const middle = frame.closed() ? (low + high) / 2 : Math.max((low + high) / 2, low + (0.16 * height) / scale);
    return {
      scale,
      x: (r) => width / 2 + scale * r,
      y: (z) => height / 2 - scale * (z - middle),
    };
  }

  path(context, frame, view, side) {
    for (let i = 0; i < frame.count; ++i) context.lineTo(view.x(side * frame.r(i)), view.y(frame.z(i)));
  }

  /** The whole meridian, from the left rim over the axis to the right one. */
  outline(context, frame, view) {
    context.beginPath();
    for (let i = frame.count - 1; i >= 0; --i) context.lineTo(view.x(-frame.r(i)), view.y(frame.z(i)));
    this.path(context, frame, view, 1);
  }

  draw(frame, kept) {
    const { context, width, height } = fitted(this.canvas);
    const colours = theme();
    context.fillStyle = colours.inside;
    context.fillRect(0, 0, width, height);
    if (!frame) return;
    const view = this.view(frame, width, height);
    this.outline(context, frame, view);
    if (!frame.closed()) {
      const rim = view.y(frame.z(frame.count - 1));
      context.lineTo(width + 2, rim);
      context.lineTo(width + 2, height);
      context.lineTo(-2, height);
      context.lineTo(-2, rim);
    }
    context.closePath();
    context.fillStyle = colours.outside;
    context.fill();
    if (kept) this.drawKept(context, kept, view, colours);
    this.drawMembrane(context, frame, view, colours);
    if (this.arrows) this.drawArrows(context, frame, view, colours);
    this.drawWords(context, frame, view, width, height, colours);
  }

  drawKept(context, kept, view, colours) {
    context.setLineDash([6, 5]);
    context.lineWidth = 2;
    context.strokeStyle = colours.kept;
    this.outline(context, kept, view);
    context.stroke();
    context.setLineDash([]);
  }

  drawMembrane(context, frame, view, colours) {
    const bare = rgb(colours.bare), coated = rgb(colours.coated);
    context.lineCap = "round";
    context.lineJoin = "round";
    const steps = 24;  // neighbours of nearly the same colour are one stroke
    for (const side of [-1, 1]) {
      let i = 0;
      while (i + 1 < frame.count) {
        const shade = Math.round(steps * 0.5 * (frame.c(i) + frame.c(i + 1)));
        context.beginPath();
        context.moveTo(view.x(side * frame.r(i)), view.y(frame.z(i)));
        do {
          ++i;
          context.lineTo(view.x(side * frame.r(i)), view.y(frame.z(i)));
        } while (i + 1 < frame.count && Math.round(steps * 0.5 * (frame.c(i) + frame.c(i + 1))) === shade);
        context.strokeStyle = mixed(bare, coated, shade / steps);
        context.lineWidth = 3.5 + (2 * shade) / steps;
        context.stroke();
      }
    }
  }

  drawArrows(context, frame, view, colours) {
    let fastest = 0;
    for (let i = 0; i < frame.count; ++i) fastest = Math.max(fastest, Math.hypot(...frame.u(i)));
    if (fastest === 0) return;
    context.strokeStyle = context.fillStyle = colours.ink;
    context.lineWidth = 1.5;
    const longest = Math.min(46, this.canvas.clientWidth / 12);
    const every = Math.max(1, Math.round((0.6 * frame.count * longest) / this.canvas.clientWidth));
    for (const side of [-1, 1]) {
      for (let i = every; i < frame.count; i += every) {
        const [u, w] = frame.u(i), length = Math.hypot(u, w) / fastest * longest;
        if (length < 3) continue;
        const x = view.x(side * frame.r(i)), y = view.y(frame.z(i));
        const angle = Math.atan2(-w, side * u), tx = x + length * Math.cos(angle), ty = y + length * Math.sin(angle);
        context.beginPath();
        context.moveTo(x, y);
        context.lineTo(tx, ty);
        context.stroke();
        context.beginPath();
        context.moveTo(tx + 5 * Math.cos(angle), ty + 5 * Math.sin(angle));
        context.lineTo(tx + 3 * Math.cos(angle + 2), ty + 3 * Math.sin(angle + 2));
        context.lineTo(tx + 3 * Math.cos(angle - 2), ty + 3 * Math.sin(angle - 2));
        context.fill();
      }
    }
    context.font = "13px system-ui, sans-serif";
    context.textAlign = "left";
    context.fillText(`longest arrow: ${short(fastest)} nm/µs`, 14, 44);
  }

  drawWords(context, frame, view, width, height, colours) {
    const bar = [100, 50, 20, 10, 5, 2, 1].find((length) => length * view.scale < width / 5) ?? 1;
    context.fillStyle = context.strokeStyle = colours.muted;
    context.font = "13px system-ui, sans-serif";
    context.lineWidth = 2;
    context.beginPath();
    context.moveTo(width - 16 - bar * view.scale, height - 16);
    context.lineTo(width - 16, height - 16);
    context.stroke();
    context.textAlign = "right";
    context.fillText(`${bar} nm`, width - 16, height - 24);
    context.textAlign = "left";
    context.fillText("outside the cell", 14, height - 14);
    if (!frame.closed()) context.fillText("inside the cell", 14, 24);
  }
}

/** Three digits of a number, without exponent where it can be. */
function short(value) {
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 1e5 || size < 1e-3) return value.toExponential(1).replace("e+", "e");
  return String(Number(value.toPrecision(3)));
}
