// The membrane in space: a surface of revolution with a displacement w cos mφ along its normal, drawn from back to front.

const SIDES = 72;          // quads around
const TILT = 0.42;         // of the view from above, radians
const LIGHT = [-0.45, 0.75, 0.5];
const INWARD = [43, 106, 181], NEUTRAL = [226, 226, 222], OUTWARD = [190, 60, 50];

/** The colour channels of a displacement from −1 to 1. */
function displacementColour(value) {
  const end = value < 0 ? INWARD : OUTWARD, part = Math.min(1, Math.abs(value));
  return NEUTRAL.map((channel, i) => channel + part * (end[i] - channel));
}

/** A view on `canvas`; returns {draw(frame, mode, w, amount, angle), resize()}. */
function surfaceView(canvas, frames) {
  const context = canvas.getContext("2d");
  const flat = (name) => frames.flatMap((frame) => frame[name]);
  const rim = Math.max(...flat("r")), lowest = Math.min(...flat("z")), highest = Math.max(...flat("z"));
  const middle = (lowest + highest) / 2;
  let width = 1, height = 1, scale = 1;

  function resize() {
    const ratio = window.devicePixelRatio || 1;
    width = canvas.clientWidth;
    height = Math.max(320, Math.min(0.6 * window.innerHeight, width * 0.75));
    scale = Math.min(width / (2.15 * rim), height / ((highest - lowest) * Math.cos(TILT) + 2.2 * rim * Math.sin(TILT)));
    canvas.style.height = `${height}px`;
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
  }

  /** Points of the displaced surface in the camera's coordinates: right, up, towards the eye. */
  function vertices(frame, mode, w, amount, angle) {
    const points = [];
    for (let k = 0; k < SIDES; ++k) {
      const azimuth = (2 * Math.PI * k) / SIDES;
      const along = amount * Math.cos(mode * azimuth), c = Math.cos(azimuth + angle), s = Math.sin(azimuth + angle);
      points.push(frame.r.map((r, i) => {
        const radius = r + along * w[i] * frame.nr[i], up = frame.z[i] + along * w[i] * frame.nz[i] - middle;
        const x = radius * c, y = radius * s;
        return [x, up * Math.cos(TILT) - y * Math.sin(TILT), up * Math.sin(TILT) + y * Math.cos(TILT)];
      }));
    }
    return points;
  }

  function quads(points, mode, w) {
    const result = [];
    for (let k = 0; k < SIDES; ++k) {
      const here = points[k], there = points[(k + 1) % SIDES];
      const factor = Math.cos((2 * Math.PI * mode * (k + 0.5)) / SIDES);
      for (let i = 0; i + 1 < here.length; ++i) {
        const corners = [here[i], here[i + 1], there[i + 1], there[i]];
        const depth = corners[0][2] + corners[1][2] + corners[2][2] + corners[3][2];
        result.push({ corners, depth, value: (factor * (w[i] + w[i + 1])) / 2 });
      }
    }
    return result.sort((a, b) => a.depth - b.depth);
  }

  /** Brightness of a quad, the same from both sides. */
  function brightness([a, b, c, d]) {
    const u = [0, 1, 2].map((i) => c[i] - a[i]), v = [0, 1, 2].map((i) => d[i] - b[i]);
    const n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    const size = Math.hypot(...n) || 1;
    const facing = n[2] < 0 ? -1 : 1;
    return 0.52 + 0.48 * Math.max(0, (facing * (n[0] * LIGHT[0] + n[1] * LIGHT[1] + n[2] * LIGHT[2])) / size);
  }

  function draw(frame, mode, w, amount, angle) {
    context.clearRect(0, 0, width, height);
    context.lineWidth = 0.7;
    for (const { corners, value } of quads(vertices(frame, mode, w, amount, angle), mode, w)) {
      const light = brightness(corners);
      context.fillStyle = context.strokeStyle =
        `rgb(${displacementColour(value).map((channel) => Math.round(light * channel)).join(" ")})`;
      context.beginPath();
      corners.forEach(([x, y], i) => {
        const at = [width / 2 + scale * x, height / 2 - scale * y];
        if (i === 0) context.moveTo(...at); else context.lineTo(...at);
      });
      context.closePath();
      context.fill();
      context.stroke();
    }
  }

  return { draw, resize };
}
