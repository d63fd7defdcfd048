"use strict";
// What a visitor takes along: case, history, picture, film.

function save(name, content, type) {
  const blob = content instanceof Blob ? content : new Blob([content], { type });
  const anchor = element("a", { href: URL.createObjectURL(blob), download: name });
  anchor.click();
  setTimeout(() => URL.revokeObjectURL(anchor.href), 10000);
}

/** A case file that the command line runs unchanged. */
function caseFile(settings, version) {
  return `# Made in the browser's laboratory of endoflow ${version}.\n#     endoflow run boundary-integral case.toml\n\n${settings.toToml()}`;
}

const filmType = () => (typeof MediaRecorder === "undefined" || !HTMLCanvasElement.prototype.captureStream
  ? undefined
  : ["video/webm;codecs=vp9", "video/webm;codecs=vp8", "video/webm"].find((type) => MediaRecorder.isTypeSupported(type)));

/** Films what `play` draws on the canvas; play() returns a promise of its end. */
async function film(canvas, play) {
  const recorder = new MediaRecorder(canvas.captureStream(30), { mimeType: filmType(), videoBitsPerSecond: 6e6 });
  const parts = [];
  recorder.ondataavailable = ({ data }) => parts.push(data);
  const ended = new Promise((resolve) => { recorder.onstop = resolve; });
  recorder.start();
  await play();
  recorder.stop();
  await ended;
  return new Blob(parts, { type: "video/webm" });
}
