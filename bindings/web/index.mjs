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

/** Words about any value: some have none of their own. */
function shown(value) {
  try {
    return String(value);
  } catch {
    return 'of another type';
  }
}

function whereOf(build, locateFile) {
  if (!locateFile) return build.url();
  try {
    return new URL(locateFile(build.file), globalThis.location?.href ?? import.meta.url);
  } catch (error) {
    throw new InciseError(`locateFile has to return the address of ${build.file}: ${error.message}`, 'BadArgument');
  }
}

async function fetchModule(where) {
  if (where.protocol === 'file:') {
    const { readFile } = await import(/* @vite-ignore */ /* webpackIgnore: true */ 'node:fs/promises');
    return WebAssembly.compile(await readFile(where));
  }
  const response = await fetch(where);
  if (!response.ok) throw new Error(`the server answers ${response.status}`);
  // Servers that do not know .wasm send another type, which streaming refuses.
  const streams = response.headers.get('Content-Type')?.startsWith('application/wasm');
  return streams ? WebAssembly.compileStreaming(response) : WebAssembly.compile(await response.arrayBuffer());
}

/** The module, and how it is named in messages. */
async function compile(build, { locateFile, wasmBinary }) {
  if (wasmBinary) {
    const module = await WebAssembly.compile(bytesOf(wasmBinary)).catch((error) => {
      throw new InciseError(`wasmBinary is no WebAssembly module: ${error.message}`, 'BadArgument');
    });
    return { module, name: 'wasmBinary', code: 'BadArgument' };
  }
  const where = whereOf(build, locateFile);
  const module = await fetchModule(where).catch((error) => {
    throw new InciseError(`${where}: ${error.message}; see locateFile`, 'BadFile');
  });
  return { module, name: `${where} (see locateFile)`, code: 'BadFile' };
}

async function instantiate(options) {
  if (typeof WebAssembly !== 'object') throw new InciseError('this engine has no WebAssembly; use a newer one', 'Unsupported');
  const build = options.simd ?? (hasSimd() && accepts(EXCEPTIONS_PROBE)) ? WITH_SIMD : PLAIN;
  const [{ module, name, code }, { default: create }] = await Promise.all([compile(build, options), build.core()]);
  return new Promise((resolve, reject) => {
    const refuse = (error) => reject(new InciseError(`${name} is not ${build.file} of this package: ${error.message}`, code));
    const instantiateWasm = (imports, done) => {
      WebAssembly.instantiate(module, imports).then(done).catch(refuse);
      return {};
    };
    create({ instantiateWasm, print: options.print ?? (() => {}), printErr: options.print ?? (() => {}) }).then(resolve, refuse);
  });
}

/** Where memory is out C++ throws: an exception of WebAssembly's own, or in the build without them a number. */
const isOutOfMemory = (error) => typeof error === 'number' || (WebAssembly.Exception && error instanceof WebAssembly.Exception) ||
  (error instanceof RangeError && /alloc|array length/i.test(error.message));

/** Makes a call of the module. What C++ throws becomes an `InciseError` with a `cause`: the module is then not to be trusted. */
function told(call) {
  try {
    return call();
  } catch (error) {
    if (!isOutOfMemory(error)) throw error;
    const known = new InciseError('memory is out: use a smaller mesh, and load the module anew', 'OutOfMemory');
    throw Object.assign(known, { cause: error });
  }
}

/** An object of the module all of whose calls are told of that way. */
const guarded = (core) => new Proxy(core, {
  get(object, key) {
    const value = told(() => object[key]);
    return typeof value === 'function' ? (...given) => told(() => value.apply(object, given)) : value;
  },
});

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

/** What a file is written as. */
function extensionOf(extension) {
  if (typeof extension === 'string') return extension;
  throw new InciseError('extension has to be a text, such as ".mesh"', 'BadArgument');
}

const lastPart = (path) => path.split('/').pop();

/** Bytes by name of the files that lie beside what is opened; nothing where there are none. */
function besideOf(files, opened) {
  if (files === undefined || files === null) return undefined;
  if (typeof files !== 'object') throw new InciseError('files has to be an object: the bytes of each file by its name', 'BadArgument');
  const names = Object.keys(files), places = [opened, ...names].map(lastPart);
  const twice = places.find((place, i) => places.indexOf(place) !== i);
  if (twice !== undefined) throw new InciseError(`two files are called ${twice}: give one of them another name`, 'BadArgument');
  return Object.fromEntries(names.map((name) => [name, bytesOf(files[name])]));
}

/** A blade's path as JSON. */
function pathOf(blade) {
  if (typeof blade === 'string') return blade;
  try {
    const text = typeof blade === 'object' && blade !== null ? JSON.stringify(blade) : undefined;
    if (text !== undefined) return text;
  } catch { /* one that leads back into itself */ }
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
  if (place < 0) throw new InciseError(`${what} has to be one of ${list.join(', ')}; it is ${shown(word)}`, 'BadArgument');
  return place;
}

const dispose = Symbol.dispose ?? Symbol.for('Symbol.dispose');

/** Holds an object of the module until it is disposed of. */
class Held {
  #core;
  #guard;
  constructor(core) {
    this.#core = core;
    this.#guard = guarded(core);
  }
  get core() {
    if (!this.#core) throw new InciseError('it has been disposed of', 'BadArgument');
    return this.#guard;
  }
  dispose() {
    this.#core?.delete();
    this.#core = this.#guard = null;
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
      return new Engine(checked(told(() => module.Engine.open(bytesOf(bytes), nameOf(name)))));
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
      return checked(this.#core.write(extensionOf(extension)));
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
      const beside = besideOf(files, nameOf(name)), upwards = up ? vectorOf(up, 'up') : undefined;
      return new Session(checked(told(() => module.Session.open(bytesOf(bytes), name, beside, upwards))));
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
      return checked(this.#core.write(extensionOf(extension)));
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
    look: (theme) => told(() => module.look(placeIn(['light', 'dark'], theme, 'theme') === 1)),
    Engine: makeEngine(module),
    Session: makeSession(module, tools, colors),
  });
}
