// SPDX-License-Identifier: Apache-2.0
// What worker.mjs starts: a session that runs at the pace of the clock and shows its frames to the page.
import { load } from './index.mjs';

const STILL_FRAMES = 20; // without motion, and the body is said to be at rest
const STILL = 2e-5; // of the body's size, in a frame
const IDLE_FRAMES = 600; // after the last hand, whatever still trembles
const SPREAD = 3; // frames
const REPLAY_SECONDS = 12; // that a recording takes at most

let incise, session, size = 1, viewport = [960, 640, 640];
let events = [], last, stillFrames = 0, replayed = false;
let isAwake = true, idleFrames = 0, isWanted = false, isShown = true, hasNewTriangles = true, timer = 0, perFrame = 1;
let rate = { frames: 0, since: 0, value: 0, longest: 0 };

const say = (type, data = {}, transfer = []) => postMessage({ type, ...data }, transfer);
const errorOf = (error) => ({ message: error?.message ?? String(error), code: error?.code ?? 'Internal', ids: error?.ids ?? [] });

/** Cuts a small cube, so that engines compile what cutting takes before a person cuts. */
function warmUp() {
  const scene = { format: 'incise-scene', version: 1, length_unit: 0.1, model: { box: { cells: [2, 2, 2], size: [1, 1, 1] } } };
  const small = incise.Session.open(JSON.stringify(scene), 'warm.json');
  small.resize(100, 100);
  small.refresh();
  small.pointer('press', 45, 40);
  for (let i = 0; i < 4; ++i) {
    small.pointer('move', 45 + 3 * i, 42 + 4 * i);
    small.frame();
    small.refresh();
  }
  small.pointer('release', 57, 58);
  small.frame();
  small.undo();
  small.dispose();
}

function open({ bytes, name, files, up }) {
  const next = incise.Session.open(bytes, name, { files, up });
  session?.dispose(); // only now: where the new one fails, the old one stays
  session = next;
  session.resize(...viewport);
  events = [];
  wake();
  session.refresh();
  size = extent(session.surface().positions);
  hasNewTriangles = true;
  last = undefined;
  replayed = false;
  if (session.isReplay) {
    const calls = session.place().calls;
    perFrame = Math.max(1, Math.ceil(calls / (60 * REPLAY_SECONDS)));
  }
  return { title: session.title, tets: session.figures().tets, isReplay: session.isReplay };
}

function extent(positions) {
  let low = Infinity, high = -Infinity;
  for (const x of positions) {
    low = Math.min(low, x);
    high = Math.max(high, x);
  }
  return Math.max(high - low, 1e-30);
}

function wake() {
  isAwake = true;
  stillFrames = idleFrames = 0;
}

/** Whether the surface moved by more than a hair since the last frame. */
function moves(positions) {
  if (!last || last.length !== positions.length) return true;
  const most = STILL * size;
  for (let i = 0; i < positions.length; i += 7) {
    if (Math.abs(positions[i] - last[i]) > most) return true;
  }
  return false;
}

/**
 * Hands events to the tools. Those of a drag come in batches, one for each picture: they are spread over the frames until
 * the next batch, so that a fast drag is cut along its curve and not along a chord.
 */
function feed() {
  const most = session.isBusy ? Math.ceil(events.length / SPREAD) : events.length;
  const taken = events.splice(0, most);
  for (const [kind, x, y, options] of taken) session.pointer(kind, x, y, options);
  return taken.length > 0;
}

function step() {
  if (session.isReplay) {
    for (let i = 0; i < perFrame; ++i) session.frame();
    const { call, calls } = session.place();
    if (call >= calls && !replayed) {
      replayed = true;
      say('replayed', { verdict: session.log().at(-1) ?? '', hash: session.hash });
      session.takeOver();
    }
  } else {
    session.frame();
  }
  if (session.refresh()) hasNewTriangles = true;
}

function show(withSurface) {
  isWanted = false;
  const data = { camera: session.camera(), figures: session.figures(), isReplay: session.isReplay, isAwake };
  if (session.isReplay) data.place = session.place();
  data.figures.rate = rate.value;
  data.figures.longestFrameMs = rate.longest;
  const transfer = [];
  const take = (array) => {
    const copy = array.slice();
    transfer.push(copy.buffer);
    return copy;
  };
  const marks = session.marks();
  data.marks = { lines: take(marks.lines), balls: take(marks.balls), triangles: take(marks.triangles) };
  if (withSurface || hasNewTriangles) {
    const surface = session.surface();
    data.surface = { positions: take(surface.positions), normals: take(surface.normals) };
    if (hasNewTriangles) data.surface.looks = take(surface.looks);
    hasNewTriangles = false;
  }
  say('frame', data, transfer);
}

function count(ms) {
  ++rate.frames;
  rate.longest = Math.max(rate.longest, ms);
  const now = performance.now();
  if (now - rate.since >= 500) {
    rate.value = (1000 * rate.frames) / (now - rate.since);
    rate.frames = 0;
    rate.since = now;
  }
}

let hasMoved = true;
function tick() {
  const began = performance.now();
  let pause = 16;
  if (session && isShown) {
    try {
      const hadEvents = feed();
      if (session.isBusy || session.isReplay) wake();
      if (isAwake) {
        pause = 1000 * session.figures().frameSeconds;
        step();
        const { positions } = session.surface();
        stillFrames = moves(positions) ? 0 : stillFrames + 1;
        last = positions.slice();
        hasMoved = true;
        if (stillFrames > STILL_FRAMES || ++idleFrames > IDLE_FRAMES) isAwake = false;
        count(performance.now() - began);
      }
      if (isWanted && (hasMoved || hadEvents || hasNewTriangles)) {
        show(hasMoved);
        hasMoved = false;
      }
    } catch (error) {
      say('failed', { error: errorOf(error) });
    }
  }
  timer = setTimeout(tick, Math.max(0, pause - (performance.now() - began)));
}

const answers = {
  open,
  undo: () => act(() => session.undo()),
  redo: () => act(() => session.redo()),
  reset: () => act(() => session.reset()),
  cancel: () => session.cancel(),
  frameBody: () => act(() => session.frameBody()),
  takeOver: () => act(() => session.takeOver()),
  tool: ({ name }) => act(() => (session.tool = name)),
  depth: ({ share }) => act(() => (session.depth = share)),
  hash: () => session.hash,
  quality: () => ({ ...session.quality(), pieces: session.pieces, log: session.log() }),
  recording: () => session.recording(),
  write: ({ extension }) => session.write(extension),
  look: ({ theme }) => incise.look(theme),
  memory: () => performance.memory?.usedJSHeapSize ?? 0,
};

function act(what) {
  const result = what();
  wake();
  if (session.refresh()) hasNewTriangles = true;
  hasMoved = true;
  return result;
}

onmessage = ({ data }) => {
  if (data.type === 'events') {
    events.push(...data.events);
  } else if (data.type === 'want') {
    isWanted = true;
  } else if (data.type === 'shown') {
    isShown = data.isShown;
  } else if (data.type === 'resize') {
    viewport = data.size;
    session?.resize(...viewport);
    hasMoved = true;
  } else if (data.type === 'ask') {
    try {
      say('answer', { id: data.id, value: answers[data.what](data.with ?? {}) });
    } catch (error) {
      say('answer', { id: data.id, error: errorOf(error) });
    }
  }
};

try {
  incise = await load();
  say('loaded', { version: incise.version, look: incise.look('dark') });
  warmUp();
  say('warm');
  clearTimeout(timer);
  tick();
} catch (error) {
  say('broken', { error: errorOf(error) });
}
