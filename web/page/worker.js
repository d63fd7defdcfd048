"use strict";
// The worker's side: the engine's module, and a run that computes in slices so that messages come through between them.

/** What a module without a file system asks of its host: a clock, and somewhere to print to. */
function host(exports) {
  const view = () => new DataView(exports().memory.buffer);
  const none = () => 0;
  return {
    env: { emscripten_notify_memory_growth: none },
    wasi_snapshot_preview1: {
      clock_time_get(clock, _precision, out) {
        const now = clock === 0 ? Date.now() : performance.now();
        view().setBigUint64(out, BigInt(Math.round(now * 1e6)), true);
        return 0;
      },
      environ_sizes_get(count, size) {
        view().setUint32(count, 0, true);
        view().setUint32(size, 0, true);
        return 0;
      },
      environ_get: none,
      fd_write(_file, vectors, count, out) {
        let written = 0;
        for (let i = 0; i < count; ++i) written += view().getUint32(vectors + 8 * i + 4, true);
        view().setUint32(out, written, true);
        return 0;
      },
      fd_read: () => 8,
      fd_seek: () => 8,
      fd_close: none,
      proc_exit(code) { throw new Error(`the engine ended with ${code}`); },
    },
  };
}

/** Imports that this module wants and host() has not got: functions that a page's engine never calls. */
function completed(imports, module) {
  for (const { module: space, name, kind } of WebAssembly.Module.imports(module)) {
    imports[space] ??= {};
    if (kind === "function")
      imports[space][name] ??= () => { throw new Error(`the engine called ${name}, which a page has not got`); };
  }
  return imports;
}

class Engine {
  constructor(module) {
    const imports = completed(host(() => this.exports), module);
    this.exports = new WebAssembly.Instance(module, imports).exports;
    this.exports._initialize();
  }

  text(address) {
    const bytes = new Uint8Array(this.exports.memory.buffer);
    return new TextDecoder().decode(bytes.slice(address, bytes.indexOf(0, address)));
  }

  /** The answer of an exported function, which may read a text. */
  ask(name, text = "", ...numbers) {
    if (text) {
      const bytes = new TextEncoder().encode(text);
      const place = this.exports.text_buffer(bytes.length);
      new Uint8Array(this.exports.memory.buffer).set(bytes, place);
    } else if (name === "check" || name === "start") {
      this.exports.text_buffer(0);
    }
    return JSON.parse(this.text(this.exports[name](...numbers)));
  }

  shape() {
    const { memory, shape_data, shape_size } = this.exports;
    return new Float32Array(memory.buffer, shape_data(), shape_size()).slice();
  }
}

let module = null, engine = null;
let run = 0;  // number of the run that computes, 0 when none does
let budded = false;  // the run has been seen to bud, and has paused there
const SLICE = 0.012;  // s
const pause = new MessageChannel();
pause.port1.onmessage = () => { if (run) compute(); };

function progress(said, id) {
  const shape = engine.shape();
  postMessage({ type: "progress", run: id, shape, memory: engine.exports.memory.buffer.byteLength, ...said }, [shape.buffer]);
}

/** The engine's memory is in no known state after a trap: another one takes its place. */
function breakDown(failure) {
  const error = `engine-broke-down: ${failure.message}; restart, with fewer elements or a shorter run`;
  postMessage({ type: "progress", run, rows: [], warnings: [], error });
  run = 0;
  engine = new Engine(module);
}

function compute() {
  const begin = performance.now();
  let said;
  try {
    said = engine.ask("advance", "", SLICE);
  } catch (failure) {
    breakDown(failure);
    return;
  }
  said.seconds = (performance.now() - begin) / 1e3;
  said.paused = !budded && said.events.budding !== undefined && !said.ended;
  budded ||= said.paused;
  progress(said, run);
  if (said.ended || said.error || said.paused) run = 0;
  else pause.port2.postMessage(null);
}

const commands = {
  load({ bytes }) {
    module = new WebAssembly.Module(bytes);
    engine = new Engine(module);
    return engine.ask("describe");
  },
  check({ text }) { return engine.ask("check", text); },
  start({ text, id }) {
    run = 0;
    budded = false;
    const said = engine.ask("start", text);
    if (!said.error) {
      progress(said, id);
      run = id;
      pause.port2.postMessage(null);
    }
    return said;
  },
  stop() {
    const stopped = run;
    run = 0;
    return stopped;
  },
  resume({ id }) {
    run = id;
    pause.port2.postMessage(null);
    return id;
  },
  history() { return engine.text(engine.exports.history()); },
};

onmessage = ({ data: { question, command, ...rest } }) => {
  let answer;
  try {
    answer = commands[command](rest);
  } catch (failure) {
    answer = { error: String(failure.message ?? failure) };
  }
  postMessage({ type: "answer", question, answer });
};
