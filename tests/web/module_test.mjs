// SPDX-License-Identifier: Apache-2.0
// The module in node: the same results as the native command, errors, memory, and types that tell the truth.
import assert from 'node:assert/strict';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, test } from 'node:test';
import { at, hasPlain, incise, read } from './support.mjs';

const { InciseError, hasSimd, load } = await import(at('build/npm/index.mjs'));
const { Practice } = await import(at('build/npm/practice.mjs'));
const module = await load();
const builds = hasPlain ? [module, await load({ simd: false })] : [module];
const folder = mkdtempSync(join(tmpdir(), 'incise-'));
after(() => rmSync(folder, { recursive: true }));

const bunny = read('models/bunny.mesh');
const patch = read('scenes/web_patch.json');

/** Draws a stroke across the picture, a frame for each move. */
function draw(session, tool = 'Scalpel') {
  session.resize(800, 600);
  session.refresh();
  session.tool = tool;
  session.pointer('press', 330, 300);
  for (let i = 0; i <= 25; ++i) {
    session.pointer('move', 330 + 6 * i, 300 + i);
    session.frame();
    session.refresh();
  }
  session.pointer('release', 480, 325);
  for (let i = 0; i < 3; ++i) session.frame();
  session.refresh();
}

test('this engine has SIMD: the builds that are there are compared below', () => assert.equal(hasSimd(), true));

test('a plane cuts as the native command does, and undo gives the mesh back bit for bit', async () => {
  const report = JSON.parse(await incise('cut', at('models/bunny.mesh'), '--plane', '1,0.2,0,0.06', '--report', '-'));
  for (const { Engine } of builds) {
    const engine = Engine.open(bunny, 'bunny.mesh');
    const { hash, tetCount } = engine;
    const { cutTets } = engine.cutPlane([1, 0.2, 0], 0.06);
    assert.equal(engine.hash, report.hash);
    assert.equal(cutTets, report.cut.cut_tets);
    assert.equal(engine.tetCount, report.mesh.after.tets);
    assert.equal(engine.pieces, report.mesh.after.components);
    assert.equal(engine.undo(), true);
    assert.deepEqual([engine.hash, engine.tetCount], [hash, tetCount]);
    assert.equal(engine.undo(), false);
    assert.equal(engine.redo(), true);
    assert.equal(engine.hash, report.hash);
    engine.dispose();
  }
});

test('a blade file cuts as the native command does', async () => {
  const scene = at('scenes/bunny_stroke.json');
  const report = JSON.parse(await incise('cut', at('models/bunny.mesh'), '--blade', scene, '--report', '-'));
  const engine = module.Engine.open(bunny, 'bunny.mesh');
  engine.cut(readFileSync(scene, 'utf8'));
  assert.equal(engine.hash, report.hash);
});

test('a moving body under a pointer is cut alike by both builds, and the native command replays it', async () => {
  const sessions = builds.map(({ Session }) => Session.open(bunny, 'bunny.mesh', { up: [0, 1, 0] }));
  for (const session of sessions) draw(session);
  const first = sessions[0];
  assert.ok(first.figures().tets > 10668, 'the stroke did not cut');
  assert.equal(first.figures().strokes, 1);
  for (const session of sessions) assert.equal(session.hash, first.hash);
  const recording = first.recording();
  writeFileSync(join(folder, 'bunny.mesh'), bunny);
  writeFileSync(join(folder, 'drag.jsonl'), recording);
  const said = await incise('replay', join(folder, 'drag.jsonl'), '--verify');
  assert.match(said, new RegExp(first.hash));
  const again = module.Session.open(recording, 'drag.jsonl', { files: { 'bunny.mesh': bunny } });
  assert.equal(again.isReplay, true);
  again.seek(again.place().calls);
  assert.equal(again.hash, first.hash);
  assert.match(again.log().at(-1), /^End: the same state/);
});

test('a changed recording is not taken for the same', () => {
  const session = module.Session.open(patch, 'patch.json');
  draw(session);
  const lines = Buffer.from(session.recording()).toString().trimEnd().split('\n');
  lines.splice(10, 1); // a frame less
  const other = module.Session.open(lines.join('\n') + '\n', 'less.jsonl');
  other.seek(1e9);
  assert.match(other.log().at(-1), /NOT/);
});

test('a plane across a moving body leaves two pieces, which undo joins', () => {
  const session = module.Session.open(patch, 'patch.json');
  session.resize(800, 600);
  session.refresh();
  session.tool = 'Plane cut';
  session.pointer('press', 400, 20);
  session.pointer('move', 420, 580);
  session.pointer('release', 420, 580);
  assert.equal(session.isBusy, true);
  for (let i = 0; i < 100 && session.isBusy; ++i) session.frame();
  assert.equal(session.pieces, 2);
  assert.equal(session.undo(), true);
  assert.equal(session.pieces, 1);
  session.reset();
  assert.equal(session.figures().strokes, 0);
});

// --- what is drawn

/** The depth of each corner below the skin, of walls or of the skin. */
function depthsOf({ looks, places }, wantsWalls) {
  const depths = [];
  for (let i = 0; i < looks.length / 4; ++i) if (((looks[4 * i] & 1) === 1) === wantsWalls) depths.push(places[4 * i + 3]);
  return depths;
}

test('patterns stick to tissue that moves, and walls know how deep they lie', () => {
  const session = module.Session.open(patch, 'patch.json');
  session.refresh();
  const { places, positions } = session.surface(), extent = session.surface().extent;
  assert.equal(places.length / 4, positions.length / 3);
  assert.ok(Math.abs(extent - Math.hypot(84, 60, 24)) < 2, `${extent}`);
  draw(session);
  const copy = (surface) => ({ looks: surface.looks.slice(), places: surface.places.slice(), positions: surface.positions.slice() });
  const cut = copy(session.surface());
  assert.ok(depthsOf(cut, false).every((depth) => depth === 0));
  const walls = depthsOf(cut, true), deepest = Math.max(...walls) * extent;
  assert.ok(walls.length > 100 && Math.min(...walls) >= 0 && deepest > 1 && deepest < 24, `${deepest}`);
  let before = cut, later = cut;
  const equal = (a, b) => a.length === b.length && a.every((value, i) => value === b[i]);
  for (let round = 0; round < 20 && (later === cut || !equal(later.places, before.places)); ++round) {  // maintenance may still move some
    before = later;
    for (let i = 0; i < 5; ++i) session.frame();
    session.refresh();
    later = copy(session.surface());
  }
  assert.notDeepEqual(later.positions, before.positions);
  assert.deepEqual(later.places, before.places);
});

test('an instrument is in the hand while it works, and colours are the scene\'s until others are chosen', () => {
  const session = module.Session.open(patch, 'patch.json');
  session.resize(800, 600);
  session.refresh();
  assert.equal(session.marks().solids.length, 0);
  session.pointer('press', 400, 300);
  session.pointer('move', 420, 305);
  const { solids, solidCornersBeforeGhosts } = session.marks();
  assert.ok(solids.length > 0 && solids.length % 33 === 0, `${solids.length} numbers`);
  assert.equal(solidCornersBeforeGhosts, solids.length / 11);
  assert.equal(session.color, 'tissue');
  session.color = 'quality';
  assert.equal(session.color, 'quality');
  assert.throws(() => (session.color = 'mauve'), (error) => error instanceof InciseError && /tissue, region/.test(error.message));
  const bone = module.Session.open(JSON.stringify({ ...JSON.parse(patch), view: { look: 'bone', color: 'region' } }), 'bone.json');
  bone.refresh();
  assert.deepEqual([bone.surface().tissue, bone.color], [3, 'region']);
});

// --- fine surfaces

/** The surface of the unit cube as an .obj, each face of 2 n² triangles. */
function fineCube(n) {
  const lines = [];
  let count = 0;
  for (let axis = 0; axis < 3; ++axis) {
    for (const side of [0, 1]) {
      for (let i = 0; i <= n; ++i) {
        for (let j = 0; j <= n; ++j) {
          const p = [];
          p[axis] = side;
          p[(axis + 1) % 3] = i / n;
          p[(axis + 2) % 3] = j / n;
          lines.push(`v ${p.join(' ')}`);
        }
      }
      const at = (i, j) => count + 1 + i * (n + 1) + j;
      for (let i = 0; i < n; ++i) {
        for (let j = 0; j < n; ++j) {
          const square = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
          const [a, b, c, d] = side ? square : square.reverse();
          lines.push(`f ${a} ${b} ${c}`, `f ${a} ${c} ${d}`);
        }
      }
      count += (n + 1) ** 2;
    }
  }
  return new TextEncoder().encode(lines.join('\n'));
}

const FINE = 20; // squares along an edge of the surface, of a body of 4³ cells
const fineScene = JSON.stringify({
  format: 'incise-scene', version: 1, length_unit: 0.05, gravity: [0, 0, 0],
  model: { box: { cells: [4, 4, 4], size: [1, 1, 1] }, surface: 'skin.obj' },
  attachments: [{ below: [0, 0, 1, 0.01] }], view: { from: [0, -1, 1] },
});
const openFine = (Session) => Session.open(fineScene, 'fine.json', { files: { 'skin.obj': fineCube(FINE) } });

/** How many triangles the page gets of skin and of walls, and whether all places are finite. */
function count(session) {
  const { positions, looks } = session.surface();
  const walls = looks.filter((_, i) => i % 12 === 0 && looks[i] & 1).length;
  return { skin: positions.length / 9 - walls, walls, isFinite: positions.every(Number.isFinite) };
}

test('a fine surface is drawn in the place of the skin, cut with the body, and whole again after undo', () => {
  const seen = [];
  for (const { Session } of builds) {
    const session = openFine(Session);
    session.refresh();
    const whole = { skin: 12 * FINE * FINE, walls: 0, isFinite: true };
    assert.deepEqual(count(session), whole);
    draw(session);
    const cut = count(session);
    assert.ok(cut.skin > whole.skin && cut.walls > 0 && cut.isFinite, JSON.stringify(cut));
    assert.ok(session.figures().tets < whole.skin / 2, 'the body is not coarse');
    assert.equal(session.undo(), true);
    session.refresh();
    assert.deepEqual(count(session), whole);
    assert.equal(session.redo(), true);
    session.refresh();
    assert.deepEqual(count(session), cut);
    session.reset();
    session.refresh();
    assert.deepEqual(count(session), whole);
    seen.push(cut);
    session.dispose();
  }
  assert.deepEqual(seen.at(-1), seen[0]);
});

test('no triangle of a fine surface spans a body that a plane has parted', () => {
  const session = openFine(module.Session);
  session.resize(800, 600);
  session.refresh();
  session.tool = 'Plane cut';
  session.pointer('press', 400, 60);
  session.pointer('move', 402, 500);
  session.pointer('release', 402, 500);
  do session.frame(); while (session.isBusy);
  assert.equal(session.pieces, 2);
  session.tool = 'Forceps';
  session.refresh();
  session.pointer('press', 330, 250);
  for (let i = 0; i < 100; ++i) {
    session.pointer('move', 330 - 3 * i, 250);
    session.frame();
    session.refresh();
  }
  const { positions } = session.surface();
  let longest = 0;
  for (let i = 0; i < positions.length; i += 9) {
    for (const [p, q] of [[0, 3], [3, 6], [6, 0]]) {
      longest = Math.max(longest, Math.hypot(...[0, 1, 2].map((k) => positions[i + p + k] - positions[i + q + k])));
    }
  }
  const wide = Math.max(...positions.filter((_, i) => i % 3 === 0)) - Math.min(...positions.filter((_, i) => i % 3 === 0));
  assert.ok(wide > 1.2, `the pieces were not drawn apart: ${wide}`);
  assert.ok(longest < 0.6, `a triangle is ${longest} long`);
  session.dispose();
});

test('a recording of a body with a fine surface plays, and what is wrong with a surface is said', () => {
  const session = openFine(module.Session);
  draw(session);
  const recording = session.recording(), { hash } = session;
  session.dispose();
  const again = module.Session.open(recording, 'fine.jsonl', { files: { 'skin.obj': fineCube(FINE) } });
  while (again.place().call < again.place().calls) again.frame();
  again.refresh();
  assert.equal(again.hash, hash);
  assert.ok(count(again).walls > 0);
  again.dispose();
  assert.throws(() => module.Session.open(fineScene, 'fine.json'), (error) => /skin\.obj/.test(error.message));
  const far = new TextEncoder().encode('v 90 0 0\nv 91 0 0\nv 90 1 0\nf 1 2 3\n');
  assert.throws(() => module.Session.open(fineScene, 'fine.json', { files: { 'skin.obj': far } }),
    (error) => error.name === 'InciseError' && /^skin\.obj: point 0 .* outside the mesh/.test(error.message));
});

test('views of the heap are taken anew after memory has grown', () => {
  const session = module.Session.open(patch, 'patch.json');
  session.refresh();
  const before = session.surface().positions;
  const first = before.slice();
  const held = [];
  while (before.length > 0 && held.length < 40) held.push(module.Engine.open(bunny, 'bunny.mesh'));
  assert.equal(before.length, 0, 'memory did not grow: the test shows nothing');
  assert.deepEqual(session.surface().positions, first);
  held.forEach((engine) => engine.dispose());
});

test('errors are InciseErrors that name file and remedy, and nothing of the inside', () => {
  const { Engine, Session } = module;
  const thrown = (what) => {
    try {
      what();
    } catch (error) {
      assert.ok(error instanceof InciseError && error instanceof Error, String(error));
      return error;
    }
    return assert.fail('nothing was thrown');
  };
  assert.equal(thrown(() => Engine.open('nonsense', 'x.mesh')).code, 'Unsupported');
  assert.match(thrown(() => Engine.open('nonsense', 'x.mesh')).message, /^x\.mesh: /);
  const broken = bunny.subarray(0, bunny.length / 2);
  assert.equal(thrown(() => Session.open(broken, 'half.mesh')).code, 'BadFile');
  assert.match(thrown(() => Session.open(broken, 'half.mesh')).message, /^half\.mesh:\d+/);
  const engine = Engine.open(bunny, 'bunny.mesh');
  assert.equal(thrown(() => engine.cutPlane([0, 0, 0], 1)).code, 'BadArgument');
  assert.equal(thrown(() => engine.cutPlane([1, 0], 1)).code, 'BadArgument');
  assert.equal(thrown(() => engine.cut({ format: 'incise-blade', version: 1, strokes: [] })).code, 'BadFile');
  assert.equal(thrown(() => engine.write('.xyz')).code, 'BadArgument');
  assert.deepEqual(thrown(() => engine.write('.xyz')).ids, []);
  assert.match(thrown(() => engine.cut(undefined)).message, /^blade has to be/);
  assert.match(thrown(() => engine.cut(3)).message, /^blade has to be/);
  assert.match(thrown(() => engine.cutPlane(undefined, 1)).message, /^normal has to be three/);
  assert.match(thrown(() => Engine.open(bunny)).message, /^name has to be a text/);
  assert.match(thrown(() => Engine.open(null, 'x.mesh')).message, /^the bytes of a file/);
  assert.match(thrown(() => Session.open(bunny, 'bunny.mesh', { up: 'z' })).message, /^up has to be three/);
  assert.doesNotMatch(thrown(() => Engine.open('nonsense', 'x.mesh')).message, /vtu/); // this build has no XML
  assert.doesNotMatch(thrown(() => engine.write('.xyz')).message, /vtu/);
  const session = Session.open(patch, 'patch.json');
  assert.throws(() => (session.tool = 'Chainsaw'), { code: 'BadArgument' });
  assert.throws(() => session.pointer('press', NaN, 0), { code: 'BadArgument' });
  session.pointer('move', 1, 1, null);
  session.dispose();
  assert.throws(() => session.frame(), { code: 'BadArgument' });
  Session.open(patch, 'patch.json', null).dispose();
});

test('arguments of no sense are InciseErrors', () => {
  const { Engine, Session } = module, engine = Engine.open(bunny, 'bunny.mesh'), session = Session.open(patch, 'patch.json', { files: null });
  const cyclic = {}, bare = Object.create(null);
  cyclic.self = cyclic;
  const refused = [
    () => engine.cut(cyclic), () => engine.cut({ toJSON() {} }), () => engine.cut({ big: 1n }), () => Session.open(patch, 'patch.json', { files: 'x.mesh' }),
    () => Session.open(patch, 'x.json', { files: { 'a/y.mesh': bunny, 'b/y.mesh': bunny } }),
  ];
  for (const value of [Symbol('x'), bare]) {
    refused.push(() => (session.tool = value), () => (session.color = value), () => session.pointer(value, 1, 1), () => module.look(value),
      () => session.pointer('press', 1, 1, { button: value }), () => engine.write(value), () => session.write(value));
  }
  for (const what of refused) assert.throws(what, (error) => error instanceof InciseError && error.code === 'BadArgument', String(what));
});

test('a scene finds what it names in folders by the last part of its name', () => {
  const { settle, ...scene } = JSON.parse(read('scenes/web_meat.json')), cube = read('models/cube.mesh');
  const sceneOf = (file) => JSON.stringify({ ...scene, length_unit: 0.1, attachments: [], model: { file } });
  const names = ['../models/cube.mesh', '/home/me/cube.mesh', 'C:\\data\\cube.mesh'];
  for (const { Session } of builds) {
    for (const name of names) {
      const session = Session.open(sceneOf(name), 'scene.json', { files: { 'cube.mesh': cube } });
      session.frame();
      assert.equal(session.figures().tets, 750);
      const again = Session.open(session.recording(), 'again.jsonl', { files: { 'cube.mesh': cube } });
      assert.equal(again.meshHash, session.meshHash);
      [session, again].forEach((each) => each.dispose());
    }
    assert.throws(() => Session.open(sceneOf(names[0]), 'scene.json'), ({ message }) => /cube\.mesh/.test(message) && !/incise-\d/.test(message));
  }
});

test('where memory is out that is an InciseError with its code, and it is known to be the end', async () => {
  const { grow } = WebAssembly.Memory.prototype;
  for (const simd of hasPlain ? [true, false] : [true]) {
    const own = await load({ simd }), held = [];
    try {
      WebAssembly.Memory.prototype.grow = () => {
        throw new RangeError('no more');
      };
      assert.throws(() => {
        while (held.length < 40) held.push(own.Engine.open(bunny, 'bunny.mesh'));
      }, (error) => error instanceof InciseError && error.code === 'OutOfMemory' && error.cause !== undefined);
    } finally {
      WebAssembly.Memory.prototype.grow = grow;
    }
  }
});

test('a module that is not there, or another one, is an InciseError that says where to look', async () => {
  const empty = Uint8Array.of(0, 97, 115, 109, 1, 0, 0, 0), foreign = join(folder, 'foreign.wasm');
  writeFileSync(foreign, empty);
  await assert.rejects(load({ wasmBinary: empty }), (error) => error instanceof InciseError && /^wasmBinary is not incise_core\.wasm/.test(error.message));
  for (const where of ['http://127.0.0.1:1/x.wasm', 'file:///nowhere.wasm', `file://${foreign}`, 'http://', Symbol('x')]) {
    await assert.rejects(load({ locateFile: () => where }), (error) => error instanceof InciseError && /locateFile/.test(error.message), String(where));
  }
});

test('a wasmBinary that is none is an InciseError', async () => {
  await assert.rejects(load({ wasmBinary: Uint8Array.of(1, 2, 3) }), (error) => error instanceof InciseError && /^wasmBinary is no/.test(error.message));
  await assert.rejects(load({ wasmBinary: 'x' }), InciseError);
  await assert.rejects(load({ wasmBinary: 7 }), InciseError);
});

test('what is disposed of gives its memory back', () => {
  const { Engine } = builds.at(-1);
  for (let i = 0; i < 60; ++i) {
    const engine = Engine.open(bunny, 'bunny.mesh');
    engine.cutPlane([1, 0, 0], 0.02);
    engine[Symbol.dispose ?? Symbol.for('Symbol.dispose')]();
  }
});

test('practice cuts a cube, takes each stroke back, and leaves nothing', () => {
  let session;
  const practice = new Practice({ open: (...what) => (session = module.Session.open(...what)) }, 5, 30);
  const tets = [session.figures().tets];
  while (!practice.isOver) {
    practice.goOn();
    if (!practice.isOver) tets.push(session.figures().tets);
  }
  assert.equal(tets.length, 30);
  assert.ok(tets[24] > tets[0], tets.join(' '));
  assert.equal(tets[25], tets[0]);
  assert.ok(tets[29] > tets[0], tets.join(' '));
  assert.throws(() => session.frame(), { code: 'BadArgument' });
});

test('a written mesh reads back', () => {
  const engine = module.Engine.open(bunny, 'bunny.mesh');
  engine.cutPlane([0, 1, 0], 5);
  for (const extension of ['.mesh', '.msh', '.vtk']) {
    const again = module.Engine.open(engine.write(extension), `again${extension}`);
    assert.deepEqual([again.tetCount, again.vertexCount], [engine.tetCount, engine.vertexCount]);
  }
  assert.equal(engine.points().length, 3 * engine.vertexCount);
  assert.equal(engine.tets().length, 4 * engine.tetCount);
});

test('the bytes of the module may be handed over', async () => {
  const own = await load({ wasmBinary: read('build/npm/incise_core.wasm') });
  assert.equal(own.Engine.open(bunny, 'bunny.mesh').tetCount, 10668);
  const asked = [];
  const located = await load({ locateFile: (name) => asked.push(name) && new URL(`file://${at('build/npm')}/${name}`).href });
  assert.deepEqual(asked, ['incise_core.wasm']);
  assert.equal(located.version, module.version);
});

test('an engine that lacks SIMD, or exceptions of its own, is given the build that does without both', async () => {
  const { validate } = WebAssembly;
  const holds = (bytes, part) => bytes.some((_, i) => part.every((byte, k) => bytes[i + k] === byte));
  const vectors = [253, 15], tries = [6, 64]; // i8x16.splat; try without a result
  try {
    for (const lacks of [vectors, tries]) {
      WebAssembly.validate = (bytes) => !holds(bytes, lacks) && validate(bytes);
      const asked = [];
      await load({ locateFile: (name) => asked.push(name) && 'file:///nowhere' }).catch(() => {});
      assert.deepEqual(asked, ['incise_plain.wasm']);
    }
  } finally {
    WebAssembly.validate = validate;
  }
});

test('index.d.mts names the tools of the module', () => {
  const union = read('build/npm/index.d.mts').toString().match(/export type ToolName = (.*);/)[1];
  assert.deepEqual(union.split(' | '), module.tools.map((tool) => `'${tool}'`));
});

test('index.d.mts declares what the module has, and no more', () => {
  const typescript = createRequire(at('web/package.json'))('typescript');
  const source = typescript.createSourceFile('index.d.mts', read('build/npm/index.d.mts').toString(), typescript.ScriptTarget.Latest);
  const declared = { class: {}, interface: {}, function: new Set() };
  const name = (node) => node.name?.text ?? node.name?.escapedText;
  source.forEachChild((node) => {
    const kind = typescript.isClassDeclaration(node) ? 'class' : typescript.isInterfaceDeclaration(node) ? 'interface' : null;
    if (kind) declared[kind][name(node)] = node.members;
    if (typescript.isFunctionDeclaration(node)) declared.function.add(name(node));
  });
  const isStatic = (node) => node.modifiers?.some((each) => each.kind === typescript.SyntaxKind.StaticKeyword);
  const members = (nodes, wantsStatic) => [...nodes].filter((node) => name(node) && Boolean(isStatic(node)) === wantsStatic).map(name).sort();
  const own = (object) => Object.getOwnPropertyNames(object).filter((key) => !['constructor', 'length', 'name', 'prototype'].includes(key)).sort();
  for (const type of ['Engine', 'Session']) {
    assert.deepEqual(own(module[type].prototype), members(declared.class[type], false));
    assert.deepEqual(own(module[type]), members(declared.class[type], true));
  }
  assert.deepEqual(own(module), members(declared.interface.Incise, false));
  const session = module.Session.open(patch, 'patch.json');
  const returned = { Figures: session.figures(), Marks: session.marks(), Surface: session.surface(), CameraMatrices: session.camera() };
  returned.QualityFigures = session.quality().now;
  returned.Look = module.look('dark');
  returned.Ink = returned.Look.inks[0];
  returned.Shader = returned.Look.shaders.solids;
  for (const [type, value] of Object.entries(returned)) assert.deepEqual(own(value), members(declared.interface[type], false), type);
  assert.deepEqual([...declared.function].sort(), ['hasSimd', 'load']);
});
