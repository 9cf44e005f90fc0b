// SPDX-License-Identifier: Apache-2.0
// The package `incise`: loads the WebAssembly module and gives it a JavaScript face. Types and units: index.d.mts.

/** What a call threw that could not do what was asked. */
export class InciseError extends Error {
  constructor(message, code, ids = []) {
    super(message);
    this.name = 'InciseError';
    this.code = code;
    this.ids = ids;
  }
}

// A function that loads, adds a vector and drops the result: an engine without SIMD refuses it.
const SIMD_PROBE = Uint8Array.of(0, 97, 115, 109, 1, 0, 0, 0, 1, 5, 1, 96, 0, 1, 123, 3, 2, 1, 0, 10, 10, 1, 8, 0, 65, 0,
  253, 15, 253, 98, 11);
// A function that tries nothing and catches all: an engine without exceptions of WebAssembly's own refuses it.
const EXCEPTIONS_PROBE = Uint8Array.of(0, 97, 115, 109, 1, 0, 0, 0, 1, 4, 1, 96, 0, 0, 3, 2, 1, 0, 10, 8, 1, 6, 0, 6, 64, 25,
  11, 11);
const accepts = (probe) => typeof WebAssembly === 'object' && WebAssembly.validate(probe);

/** Whether this engine has WebAssembly's SIMD instructions. */
export function hasSimd() {
  return accepts(SIMD_PROBE);
}

// Bundlers look for exactly this form of URL and take the file along.
const WITH_SIMD = {
  file: 'incise_core.wasm',
  url: () => new URL('./incise_core.wasm', import.meta.url),
  core: () => import('./incise_core.mjs'),
};
const PLAIN = {
  file: 'incise_plain.wasm',
  url: () => new URL('./incise_plain.wasm', import.meta.url),
  core: () => import('./incise_plain.mjs'),
};

async function compile(build, { locateFile, wasmBinary }) {
  if (wasmBinary) {
    return WebAssembly.compile(bytesOf(wasmBinary)).catch((error) => {
      throw new InciseError(`wasmBinary is no WebAssembly module: ${error.message}`, 'BadArgument');
    });
  }
  const where = locateFile ? new URL(locateFile(build.file), globalThis.location?.href ?? import.meta.url) : build.url();
  if (where.protocol === 'file:') {
    const { readFile } = await import(/* @vite-ignore */ /* webpackIgnore: true */ 'node:fs/promises');
    return WebAssembly.compile(await readFile(where));
  }
  const response = await fetch(where);
  if (!response.ok) throw new InciseError(`${where}: the server answers ${response.status}; see locateFile`, 'BadFile');
  // Servers that do not know .wasm send another type, which streaming refuses.
  const streams = response.headers.get('Content-Type')?.startsWith('application/wasm');
  return streams ? WebAssembly.compileStreaming(response) : WebAssembly.compile(await response.arrayBuffer());
}

async function instantiate(options) {
  if (typeof WebAssembly !== 'object') throw new InciseError('this engine has no WebAssembly; use a newer one', 'Unsupported');
  const build = options.simd ?? (hasSimd() && accepts(EXCEPTIONS_PROBE)) ? WITH_SIMD : PLAIN;
  const [module, { default: create }] = await Promise.all([compile(build, options), build.core()]);
  return new Promise((resolve, reject) => {
    const instantiateWasm = (imports, done) => {
      WebAssembly.instantiate(module, imports).then(done, reject);
      return {};
    };
    create({ instantiateWasm, print: options.print ?? (() => {}), printErr: options.print ?? (() => {}) }).then(resolve, reject);
  });
}

/** What a call returned, or its error thrown. */
function checked(value) {
  if (value instanceof Error) throw new InciseError(value.message, value.code, value.ids);
  return value;
}

function bytesOf(data) {
  if (typeof data === 'string') return new TextEncoder().encode(data);
  if (data instanceof ArrayBuffer) return new Uint8Array(data);
  if (ArrayBuffer.isView(data)) return new Uint8Array(data.buffer, data.byteOffset, data.byteLength);
  throw new InciseError('the bytes of a file have to be a string, an ArrayBuffer or a view of one', 'BadArgument');
}

/** The name that a file goes by; its end says the format. */
function nameOf(name) {
  if (typeof name === 'string' && name !== '') return name;
  throw new InciseError('name has to be a text, such as "liver.mesh": its end says the format', 'BadArgument');
}

/** A blade's path as JSON. */
function pathOf(blade) {
  if (typeof blade === 'string') return blade;
  if (typeof blade === 'object' && blade !== null) return JSON.stringify(blade);
  throw new InciseError('blade has to be a path of format incise-blade, or its JSON', 'BadArgument');
}

/** Three finite numbers. */
function vectorOf(value, what) {
  if (value?.length === 3) return Array.from(value, (number) => numberOf(number, what));
  throw new InciseError(`${what} has to be three finite numbers`, 'BadArgument');
}

const numberOf = (value, what) => {
  if (typeof value === 'number' && Number.isFinite(value)) return value;
  throw new InciseError(`${what} has to be a finite number`, 'BadArgument');
};

const KINDS = ['move', 'press', 'release', 'wheel'];
const BUTTONS = ['left', 'right', 'middle'];

/** The place of a word in a list. */
function placeIn(list, word, what) {
  const place = list.indexOf(word);
  if (place < 0) throw new InciseError(`${what} has to be one of ${list.join(', ')}; it is ${word}`, 'BadArgument');
  return place;
}

const dispose = Symbol.dispose ?? Symbol.for('Symbol.dispose');

/** Holds an object of the module until it is disposed of. */
class Held {
  #core;
  constructor(core) {
    this.#core = core;
  }
  get core() {
    if (!this.#core) throw new InciseError('it has been disposed of', 'BadArgument');
    return this.#core;
  }
  dispose() {
    this.#core?.delete();
    this.#core = null;
  }
  [dispose]() {
    this.dispose();
  }
}

function makeEngine(module) {
  return class Engine {
    #held;
    constructor(core) {
      this.#held = new Held(core);
    }
    static open(bytes, name) {
      return new Engine(checked(module.Engine.open(bytesOf(bytes), nameOf(name))));
    }
    get #core() {
      return this.#held.core;
    }
    get tetCount() {
      return this.#core.tetCount;
    }
    get vertexCount() {
      return this.#core.vertexCount;
    }
    get pieces() {
      return this.#core.pieces;
    }
    get hash() {
      return this.#core.hash;
    }
    cut(blade) {
      return checked(this.#core.cut(pathOf(blade)));
    }
    cutPlane(normal, offset) {
      return checked(this.#core.cutPlane(vectorOf(normal, 'normal'), numberOf(offset, 'offset')));
    }
    improve() {
      checked(this.#core.improve());
    }
    undo() {
      return this.#core.undo();
    }
    redo() {
      return this.#core.redo();
    }
    points() {
      return this.#core.points();
    }
    tets() {
      return this.#core.tets();
    }
    quality() {
      return this.#core.quality();
    }
    write(extension) {
      return checked(this.#core.write(String(extension)));
    }
    dispose() {
      this.#held.dispose();
    }
    [dispose]() {
      this.dispose();
    }
  };
}

function makeSession(module, tools, colors) {
  return class Session {
    #held;
    constructor(core) {
      this.#held = new Held(core);
    }
    static open(bytes, name, options) {
      const { files, up } = options ?? {};
      const beside = files && Object.fromEntries(Object.entries(files).map(([key, data]) => [key, bytesOf(data)]));
      return new Session(checked(module.Session.open(bytesOf(bytes), nameOf(name), beside, up && vectorOf(up, 'up'))));
    }
    get #core() {
      return this.#held.core;
    }
    get tool() {
      return tools[this.#core.tool];
    }
    set tool(name) {
      this.#core.choose(placeIn(tools, name, 'tool'));
    }
    get color() {
      return colors[this.#core.color];
    }
    set color(name) {
      this.#core.chooseColor(placeIn(colors, name, 'color'));
    }
    get depth() {
      return this.#core.depth;
    }
    set depth(share) {
      this.#core.setDepth(numberOf(share, 'depth'));
    }
    get isBusy() {
      return this.#core.isBusy;
    }
    get isReplay() {
      return this.#core.isReplay;
    }
    get pieces() {
      return this.#core.pieces;
    }
    get title() {
      return this.#core.title;
    }
    get hash() {
      return this.#core.hash;
    }
    get meshHash() {
      return this.#core.meshHash;
    }
    resize(width, height, freeHeight = height) {
      this.#core.resize(numberOf(width, 'width'), numberOf(height, 'height'), numberOf(freeHeight, 'freeHeight'));
    }
    pointer(kind, x, y, options) {
      const { button = 'left', shift = false, control = false, alt = false, wheel = 0, pressure = 1 } = options ?? {};
      const keys = (shift ? 1 : 0) | (control ? 2 : 0) | (alt ? 4 : 0);
      this.#core.pointer(placeIn(KINDS, kind, 'kind'), numberOf(x, 'x'), numberOf(y, 'y'),
        placeIn(BUTTONS, button, 'button'), keys, numberOf(wheel, 'wheel'), numberOf(pressure, 'pressure'));
    }
    cancel() {
      return this.#core.cancel();
    }
    frameBody() {
      this.#core.frameBody();
    }
    frame() {
      checked(this.#core.frame());
    }
    undo() {
      return checked(this.#core.undo());
    }
    redo() {
      return checked(this.#core.redo());
    }
    reset() {
      checked(this.#core.reset());
    }
    place() {
      return this.#core.place();
    }
    seek(call) {
      checked(this.#core.seek(numberOf(call, 'call')));
    }
    takeOver() {
      return this.#core.takeOver();
    }
    refresh() {
      return this.#core.refresh();
    }
    surface() {
      return this.#core.surface();
    }
    camera() {
      return this.#core.camera();
    }
    marks() {
      return this.#core.marks();
    }
    figures() {
      return this.#core.figures();
    }
    quality() {
      return this.#core.quality();
    }
    log() {
      return this.#core.log();
    }
    recording() {
      return checked(this.#core.recording());
    }
    write(extension) {
      return checked(this.#core.write(String(extension)));
    }
    dispose() {
      this.#held.dispose();
    }
    [dispose]() {
      this.dispose();
    }
  };
}

/** Loads the module. Each call makes one of its own, with memory of its own. */
export async function load(options) {
  const module = await instantiate(options ?? {});
  const tools = Object.freeze(module.tools()), colors = Object.freeze(module.colors());
  return Object.freeze({
    version: module.version,
    tools,
    colors,
    memory: () => module.memory(),
    look: (theme) => module.look(placeIn(['light', 'dark'], theme, 'theme') === 1),
    Engine: makeEngine(module),
    Session: makeSession(module, tools, colors),
  });
}
