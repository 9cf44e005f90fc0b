// SPDX-License-Identifier: Apache-2.0
// What worker.mjs starts: a session that runs at the pace of the clock and shows its frames to the page.
import { Beat } from './beat.mjs';
import { load } from './index.mjs';
import { holdLife } from './life.mjs';
import { Practice } from './practice.mjs';

const STILL_FRAMES = 20; // without motion, and the body is said to be at rest
const STILL = 2e-5; // of the body's size, in a frame
const IDLE_FRAMES = 600; // after the last hand, whatever still trembles
const SPREAD = 3; // frames
const REPLAY_SECONDS = 12; // that a recording takes at most
const PLAY_MS = 100; // at a time: what is asked for in between is answered
const PRACTICE_FRAMES = 100; // half a second's work, as long as nobody cuts
const PRACTICE_MS = 5; // of each frame's time
const KEEP_SHARE = 0.05; // of the time, that recordings are written in

let incise, session, colorOfScene, practice, size = 1, viewport = [960, 640, 640];
let events = [], last, stillFrames = 0, replayed = false;
let isAwake = true, idleFrames = 0, isWanted = false, isShown = true, hasNewTriangles = true, perFrame = 1;
let isBusy = false, isUnseen = false, hasShown = false, isSeen = false, isKept = true, nextKeep = 0;
let rate = { frames: 0, since: 0, value: 0, longest: 0 };

const say = (type, data = {}, transfer = []) => postMessage({ type, ...data }, transfer);
const errorOf = (error) => ({ message: error?.message ?? String(error), code: error?.code ?? 'Internal', ids: error?.ids ?? [] });

function open({ bytes, name, files, up, resumes, isAtRest, isStill }) {
  const next = incise.Session.open(bytes, name, { files, up });
  if (resumes) {
    next.seek(next.place().calls);
    next.takeOver();
  }
  session?.dispose(); // only now: where the new one fails, the old one stays
  session = next;
  colorOfScene = session.color;
  isKept = true; // whoever opened it has it
  session.resize(...viewport);
  events = [];
  wake();
  isAwake = !isAtRest;
  session.refresh();
  size = extent(session.surface().positions);
  hasNewTriangles = true;
  last = undefined;
  replayed = false;
  if (session.isReplay) {
    const calls = session.place().calls;
    perFrame = isStill ? calls : Math.max(1, Math.ceil(calls / (60 * REPLAY_SECONDS)));
    isUnseen = Boolean(isStill);
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

/** Plays a share of a recording. Returns whether it has ended. */
function play() {
  const began = performance.now();
  for (let i = 0; i < perFrame && performance.now() - began < PLAY_MS; ++i) session.frame();
  const { call, calls } = session.place();
  return call >= calls;
}

function step() {
  if (!session.isReplay) session.frame();
  else if (play() && !replayed) {
    replayed = true;
    say('replayed', { verdict: session.log().at(-1) ?? '', hash: session.hash });
    session.takeOver();
    if (isUnseen) isAwake = false; // its end is what is to be seen
  }
  if (session.refresh()) hasNewTriangles = true;
}

/** Tells the page the recording, from which another worker could go on. */
function keep() {
  if (isKept || performance.now() < nextKeep) return;
  const began = performance.now(), recording = session.recording();
  isKept = true;
  nextKeep = performance.now() + (performance.now() - began) / KEEP_SHARE;
  say('kept', { recording, isAtRest: !isAwake }, [recording.buffer]);
}

function show(withSurface) {
  isWanted = false;
  hasShown = true;
  const data = { figures: session.figures(), isReplay: session.isReplay, isAwake, color: incise.colors.indexOf(session.color) };
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
  data.marks = { solidCornersBeforeGhosts: marks.solidCornersBeforeGhosts };
  for (const kind of ['lines', 'rims', 'balls', 'triangles', 'solids']) data.marks[kind] = take(marks[kind]);
  data.camera = session.camera();
  if (withSurface || hasNewTriangles) {
    const surface = session.surface();
    data.surface = { positions: take(surface.positions), normals: take(surface.normals) };
    if (hasNewTriangles) {
      const { extent, tissue } = surface;
      Object.assign(data.surface, { looks: take(surface.looks), places: take(surface.places), extent, tissue });
    }
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

/** After these nothing of the module can be trusted: memory is out, or a bug. */
const isFatal = (error) => error instanceof WebAssembly.RuntimeError || error instanceof RangeError || error?.cause !== undefined;

let hasMoved = true;
/** One frame of a session that is awake. */
function advance() {
  const began = performance.now();
  step();
  const { positions } = session.surface();
  stillFrames = moves(positions) ? 0 : stillFrames + 1;
  last = positions.slice();
  hasMoved = true;
  if (isAwake && (stillFrames > STILL_FRAMES || ++idleFrames > IDLE_FRAMES)) isAwake = isKept = false;
  count(performance.now() - began);
}

function goOn() {
  const hadEvents = feed();
  if (session.isBusy || session.isReplay) wake();
  if (session.isBusy !== isBusy) isKept = false; // a drag began or ended
  isBusy = session.isBusy;
  if (isAwake && (isSeen || !hasShown)) advance(); // where one processor does it all the first picture comes first
  if (!session.isBusy && !session.isReplay) keep();
  if (!isWanted || (isUnseen && session.isReplay) || !(hasMoved || hadEvents || hasNewTriangles)) return;
  show(hasMoved);
  hasMoved = false;
}

/** Until somebody cuts, between the frames of a body that is seen. */
function practise() {
  if (practice?.isOver || !isSeen || session.isReplay || session.isBusy || events.length > 0) return;
  const began = performance.now();
  practice ??= new Practice(incise.Session, 5, PRACTICE_FRAMES);
  while (!practice.isOver && performance.now() - began < PRACTICE_MS) practice.goOn();
}

function tick() {
  try {
    if (session && isShown) {
      goOn();
      practise();
    }
  } catch (error) {
    if (isFatal(error)) return say('broken', { error: errorOf(error) });
    say('failed', { error: errorOf(error) });
  }
  beat.wait(session ? 1000 * session.figures().frameSeconds : 16);
}
const beat = new Beat(tick);

const answers = {
  open,
  undo: () => act(() => session.undo()),
  redo: () => act(() => session.redo()),
  reset: () => act(() => session.reset()),
  cancel: () => session.cancel(),
  frameBody: () => act(() => session.frameBody()),
  takeOver: () => act(() => session.takeOver()),
  tool: ({ name }) => choose(() => (session.tool = name)),
  depth: ({ share }) => choose(() => (session.depth = share)),
  hash: () => session.hash,
  quality: () => ({ ...session.quality(), pieces: session.pieces, log: session.log() }),
  recording: () => session.recording(),
  write: ({ extension }) => session.write(extension),
  look: ({ theme }) => incise.look(theme),
  color: ({ name }) => choose(() => (session.color = name === 'scene' ? colorOfScene : name)),
  memory: () => incise.memory(),
  isKept: () => isKept,
  events: (list) => void events.push(...list),
  resize: (size) => {
    viewport = size;
    session?.resize(...viewport);
    hasMoved = true;
  },
};

function act(what) {
  const result = what();
  wake();
  isKept = false;
  if (session.refresh()) hasNewTriangles = true;
  hasMoved = true;
  return result;
}

/** What a hand will do, not the body: one at rest stays so. */
function choose(what) {
  const wasBusy = session.isBusy;
  what();
  if (wasBusy) wake();
  hasMoved = true;
}

/** What needs no body that is open. */
const ALWAYS = ['open', 'look', 'memory', 'isKept', 'events', 'resize'];

function answer({ what, with: given }) {
  if (!Object.hasOwn(answers, what)) throw Object.assign(new Error(`there is no question "${what}"; see worker.d.mts`), { code: 'BadArgument' });
  if (!session && !ALWAYS.includes(what)) throw Object.assign(new Error('no body is open yet'), { code: 'BadArgument' });
  return answers[what](given ?? {});
}

onmessage = ({ data }) => {
  if (data.type === 'want') {
    isWanted = true;
    isSeen = hasShown; // by a machine that draws slowly, which then asks for the next
    hasNewTriangles ||= Boolean(data.isWhole);
  } else if (data.type === 'shown') {
    isShown = data.isShown;
  } else if (data.type === 'ask') {
    if (early) early.push(data);
    else reply(data);
  }
};

let early = []; // what is asked while the module still loads

function reply(data) {
  try {
    say('answer', { id: data.id, value: answer(data) });
  } catch (error) {
    if (isFatal(error)) say('broken', { error: errorOf(error) });
    else say('answer', { id: data.id, error: errorOf(error) });
  }
}

holdLife((lock) => say('alive', { lock }));
try {
  incise = await load();
  say('loaded', { version: incise.version, look: incise.look('dark') });
  for (const first = new Practice(incise.Session, 2, 4); !first.isOver; ) first.goOn();
  say('warm');
  const asked = early;
  early = null;
  asked.forEach(reply);
  tick();
} catch (error) {
  say('broken', { error: errorOf(error) });
}
