"use strict";
// The page's side of the worker.

function decoded64(text) {
  const letters = atob(text), bytes = new Uint8Array(letters.length);
  for (let i = 0; i < bytes.length; ++i) bytes[i] = letters.charCodeAt(i);
  return bytes;
}

class EngineClient {
  constructor(workerSource, wasm) {
    this.worker = new Worker(URL.createObjectURL(new Blob([workerSource], { type: "text/javascript" })));
    this.waiting = new Map();
    this.questions = 0;
    this.onprogress = () => {};
    this.worker.onmessage = ({ data }) => {
      if (data.type === "progress") return this.onprogress(data);
      this.waiting.get(data.question)(data.answer);
      this.waiting.delete(data.question);
    };
    this.loaded = this.ask("load", { bytes: decoded64(wasm) });
  }

  ask(command, more = {}) {
    const question = ++this.questions;
    return new Promise((resolve) => {
      this.waiting.set(question, resolve);
      this.worker.postMessage({ question, command, ...more });
    });
  }
}
