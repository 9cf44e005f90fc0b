// SPDX-License-Identifier: Apache-2.0
// The page: controls, files and links around a session that runs in a worker.
import { Drawing } from './drawing.mjs';
import { gather } from './files.mjs';
import { Hands } from './hands.mjs';
import { icon } from './icons.mjs';
import { Keeper } from './keeper.mjs';
import { KeyHand } from './keyboard.mjs';
import { LONGEST_LINK, fromFragment, toFragment } from './link.mjs';
import { grouped } from './numbers.mjs';
import { Frames, batches, inTurn, newest } from './pacing.mjs';
import { Panel } from './panel.mjs';
import bodies from '../bodies.json';

const $ = (id) => document.getElementById(id);
const TOOLS = [
  { name: 'Orbit', label: 'View', hint: 'Drag to turn the view.' },
  { name: 'Scalpel', label: 'Scalpel', hint: 'Drag over the body: it is cut.' },
  { name: 'Plane cut', label: 'Plane', hint: 'Drag a line across the body: the plane through it cuts all of it.' },
  { name: 'Scissors', label: 'Scissors', hint: 'Drag from where they are put on; they close where you let go.' },
  { name: 'Forceps', label: 'Forceps', hint: 'Drag on tissue to pull it.' },
  { name: 'Retractor', label: 'Retractor', hint: 'Drag a lip aside: the retractor stays and holds it. A click on it lets go.' },
  { name: 'Pin', label: 'Pin', hint: 'Click on tissue to hold it there; click the pin to let go.' },
];
const LARGE_BYTES = 4_000_000; // of a file whose mesh takes a while
const REST_MS = 20; // between two pictures of a processor, which has frames to compute as well

/** For tests and the curious: what the page measured of itself. */
const measured = (window.incise = {
  state: 'loading', failures: [], frames: 0, longestBlockMs: 0, longestBlockLoadingMs: 0, mostWaiting: 0, replacements: 0, drawingReplaced: 0,
  get engine() {
    return keeper.engine;
  },
});

const keeper = new Keeper(), panel = new Panel((what) => (isReady ? ask(what) : null));
const ask = (what, data) => keeper.engine.ask(what, data);
const hintOf = (name) => TOOLS.find((each) => each.name === name).hint;

let drawing, frames, hands, tool = 'Scalpel', theme, isReady = false, hasFrame = false, hasOpened = false;
let opened = { id: '', isReplay: false }, hintTimer = 0;
let openings = 0; // that were asked for: the last one is shown, whichever comes first

function say(text, seconds = 0) {
  $('hint').textContent = text;
  clearTimeout(hintTimer);
  if (seconds > 0) hintTimer = setTimeout(() => say(hintOf(tool)), 1000 * seconds);
}

const button = (label, onclick) => Object.assign(document.createElement('button'), { textContent: label, onclick });

/** Instead of the page: why it cannot work, and what to do. */
function cover(text, remedy, ...buttons) {
  measured.state = 'covered';
  const lines = [text, remedy].map((line) => Object.assign(document.createElement('p'), { textContent: line }));
  $('cover').replaceChildren(...lines, ...buttons);
  $('cover').hidden = false;
}

/** What saves the work of engines that stopped; nothing where there is none. */
function savers() {
  const { saved } = keeper;
  if (saved.length === 0) return [];
  return [button('Save what was done', () => saved.forEach((recording) => save(new Blob([recording]), 'incise-recording.jsonl')))];
}

function failed(error) {
  if (error.code === 'Ended') return; // of a worker that died, which is told of by itself
  measured.failures.push(error.message);
  say(`That did not work: ${error.message}`, 12);
}

// --- the look

async function setTheme(next) {
  theme = next;
  document.documentElement.dataset.theme = next;
  try {
    localStorage.setItem('incise-theme', next);
  } catch { /* a page without storage */ }
  if (!drawing) return;
  drawing.setLook(await ask('look', { theme: next }));
  panel.refresh().catch(failed);
}

function firstTheme() {
  let kept = null;
  try {
    kept = localStorage.getItem('incise-theme');
  } catch { /* likewise */ }
  return ['dark', 'light'].includes(kept) ? kept : (matchMedia('(prefers-color-scheme: light)').matches ? 'light' : 'dark');
}

// --- bodies, files, links

async function fetchBytes(file) {
  const response = await fetch(new URL(`bodies/${file}`, document.baseURI)).catch(() => {
    throw new Error(`${file}: no connection; your own files still open`);
  });
  if (!response.ok) throw new Error(`${file}: the server answers ${response.status}`);
  return new Uint8Array(await response.arrayBuffer());
}

/** What a body's scene or recording names: its mesh, and its fine surface where it has one. */
async function fetchParts(body) {
  const names = [body.model ?? (body.file.endsWith('.json') ? null : body.file), body.surface].filter(Boolean);
  const files = await Promise.all(names.map(async (name) => [name, await fetchBytes(name)]));
  return Object.fromEntries(files);
}

/**
 * Opens what `gathered` finds: {what, id, ownName, note}; `ownName` where it is no row of the list, `note` to be added to what is said.
 * Nothing is done of it once something else is asked for.
 */
async function open(gathered) {
  const own = ++openings, isLast = () => own === openings;
  try {
    const found = await gathered();
    if (isLast()) await show(found, isLast);
  } catch (error) {
    if (!isLast()) return;
    $('body').value = $('body').dataset.shown ?? bodies[0].id; // which is there still
    if (hasFrame) measured.state = 'ready';
    throw error;
  }
}

async function show({ what, id, ownName, note = '' }, isLast) {
  say(what.bytes.byteLength < LARGE_BYTES ? 'Opening…' : `Opening ${what.name}, ${Math.round(what.bytes.byteLength / 1e6)} MB: it may take a minute.`);
  measured.state = 'opening';
  const isStill = matchMedia('(prefers-reduced-motion: reduce)').matches;
  const info = await keeper.open({ ...what, isStill });
  if (!info) return; // something else was asked for
  take(info, id);
  showBody(id, ownName); // before its first frame is here
  await setUp();
  if (!isLast()) return;
  if (!opened.isReplay) return say(`${grouped(measured.tets)} tets. ${note || hintOf(tool)}`);
  say(`${isStill ? 'Playing the recording; its end is shown.' : 'Playing the recording of a link or file.'} ${note}`);
}

/** A session is there. */
function take(info, id) {
  hasOpened = true;
  opened = { id, isReplay: info.isReplay };
  Object.assign(measured, { body: id, tets: info.tets });
  $('replay').hidden = !info.isReplay;
  isReady = true;
  hasFrame = false;
}

/** What hands chose holds for a session that is new, too. */
async function setUp() {
  await Promise.all([ask('tool', { name: tool }), ask('depth', { share: Number($('depth').value) })]);
  if ($('color').value !== 'scene') await ask('color', { name: $('color').value });
  want();
  await panel.refresh();
}

const want = (isWhole = false) => keeper.engine.send({ type: 'want', isWhole });

function openBody(id) {
  const body = bodies.find((each) => each.id === id) ?? bodies[0];
  return open(async () => {
    const files = body.model ? await fetchParts(body) : undefined;
    return { what: { bytes: await fetchBytes(body.file), name: body.file, files, up: body.up }, id: body.id };
  });
}

/** Opens what was chosen or dropped: one file, or several that belong together. */
async function openFiles(chosen) {
  if (chosen.length === 0) return;
  const page = bodies.flatMap(({ file, model, surface }) => [file, model, surface]).filter(Boolean);
  let found = null;
  const lacking = ({ what, missing }) => `${what.name} names ${missing.join(' and ')}: choose these files together, or drop them together`;
  try {
    await open(async () => {
      found = await gather(chosen, keeper.files, page, fetchBytes);
      const note = found.leftOut.length > 0 ? `Left out: ${found.leftOut.join(', ')}, which it does not name.` : '';
      return { what: found.what, id: '', ownName: found.what.name, note };
    });
  } catch (error) {
    throw found?.missing.length > 0 && error.code !== 'Ended' ? new Error(lacking(found)) : error;
  }
}

/** Says in the list which body is shown; '' is one that is no row of it and has one as long as it is shown. */
function showBody(id, ownName) {
  $('body').querySelector('option[value=""]')?.remove();
  if (id === '') $('body').append(new Option(ownName, ''));
  $('body').value = $('body').dataset.shown = id;
}

function openLink(found) {
  const body = bodies.find((each) => each.id === found.body);
  return open(async () => {
    const files = body ? await fetchParts(body) : undefined;
    return { what: { bytes: found.recording, name: 'link.jsonl', files }, id: body?.id ?? '', ownName: 'Of a link' };
  });
}

async function share() {
  if (opened.isReplay) return say('Once the recording is played, or you go on by hand: a link of now would hold a part of it.', 8);
  const recording = await ask('recording');
  const fragment = await toFragment(opened.id, recording);
  if (opened.id === '' || fragment.length > LONGEST_LINK) {
    save(new Blob([recording]), 'incise-recording.jsonl');
    return say(opened.id === '' ? 'Saved as a file: a link cannot hold a mesh of your own.' : 'Saved as a file: too long for a link.', 8);
  }
  history.replaceState(null, '', fragment);
  try {
    await navigator.clipboard.writeText(location.href);
    say(`Link copied: ${Math.ceil(fragment.length / 1000)} kB, and all of the session is in it.`, 8);
  } catch {
    say('The link is in the address bar: copy it from there.', 8);
  }
}

function save(blob, name) {
  const anchor = Object.assign(document.createElement('a'), { href: URL.createObjectURL(blob), download: name });
  anchor.click();
  setTimeout(() => URL.revokeObjectURL(anchor.href), 10_000);
}

async function screenshot() {
  const picture = await drawing.shoot();
  if (picture) save(picture, 'incise.png');
  else say('There is no picture now; try again in a moment.', 8);
}

// --- tools and acts

function choose(name) {
  tool = name;
  for (const button of $('tools').children) {
    const isChosen = button.dataset.tool === name;
    button.setAttribute('aria-checked', isChosen);
    button.tabIndex = isChosen ? 0 : -1;
  }
  $('picture').style.cursor = name === 'Orbit' ? 'grab' : 'crosshair';
  if (!isReady) return;
  ask('tool', { name }).catch(failed);
  say(hintOf(name));
}

const turns = inTurn();
let keyHand = null;

async function act(what, isRepeat) {
  if (!isReady) return;
  if (what !== 'frameBody') keyHand.letGo(); // what is under way is given up
  const turn = turns(() => ask(what), isRepeat);
  const done = await turn?.catch(failed);
  if (done === false && what !== 'cancel') say(what === 'undo' ? 'Nothing to take back.' : 'Nothing to make again.', 3);
  panel.refresh().catch(failed);
}

function makeTools() {
  for (const { name, label, hint } of TOOLS) {
    const button = document.createElement('button');
    button.setAttribute('role', 'radio');
    button.dataset.tool = name;
    button.title = hint;
    button.append(icon(name), Object.assign(document.createElement('span'), { textContent: label }));
    button.onclick = () => choose(name);
    $('tools').append(button);
  }
  $('tools').onkeydown = (event) => {
    const step = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 }[event.key];
    if (!step) return;
    event.preventDefault();
    const at = TOOLS.findIndex((each) => each.name === tool);
    choose(TOOLS[(at + step + TOOLS.length) % TOOLS.length].name);
    $('tools').querySelector('[aria-checked="true"]').focus();
  };
  for (const place of document.querySelectorAll('[data-icon]')) place.replaceWith(icon(place.dataset.icon));
  choose(tool);
}

function toggle(id) {
  const isShown = $(id).hidden;
  leaveRoom();
  for (const other of ['figures', 'help']) {
    $(other).hidden = other !== id || !isShown;
    $(`${other}-button`).setAttribute('aria-expanded', !$(other).hidden);
  }
  panel.refresh().catch(failed);
}

/** Closes what lies over the body. Returns whether something did. */
function closePanels() {
  const shown = ['figures', 'help'].find((id) => !$(id).hidden);
  if (shown) toggle(shown);
  return shown !== undefined;
}

function changeDepth(by) {
  $('depth').value = Number($('depth').value) + by;
  $('depth').oninput();
}

const sendDepth = newest((share) => ask('depth', { share }).catch(failed));

const KEYS = {
  ...Object.fromEntries(TOOLS.map(({ name }, i) => [i + 1, () => choose(name)])),
  r: () => act('reset'), Home: () => act('frameBody'), Escape: () => (closePanels() ? undefined : act('cancel')),
  f: () => toggle('figures'), h: () => toggle('help'), '?': () => toggle('help'),
  t: () => setTheme(theme === 'dark' ? 'light' : 'dark'), '[': () => changeDepth(-0.04), ']': () => changeDepth(0.04),
};

function onKey(event) {
  const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
  if (event.target.matches('select, input:not([type=range])') || (key === 'Home' && event.target.matches('input'))) return;
  if (event.ctrlKey || event.metaKey) {
    const what = key === 'z' ? (event.shiftKey ? 'redo' : 'undo') : key === 'y' ? 'redo' : null;
    if (!what) return;
    event.preventDefault();
    return act(what, event.repeat);
  }
  if (event.altKey || !KEYS[key]) return;
  event.preventDefault();
  Promise.resolve(KEYS[key]()).catch(failed);
}

function hearControls() {
  const hear = (id, what) => ($(id).onclick = () => Promise.resolve(what()).catch(failed));
  const hearReady = (id, what) => hear(id, () => (isReady && drawing ? what() : say('It is still loading; a moment.')));
  for (const what of ['undo', 'redo', 'reset']) hear(what, () => act(what));
  hearReady('share', share);
  hearReady('shot', screenshot);
  hear('theme', () => setTheme(theme === 'dark' ? 'light' : 'dark'));
  hear('figures-button', () => toggle('figures'));
  hear('help-button', () => toggle('help'));
  hear('take-over', async () => {
    await ask('takeOver');
    endReplay();
  });
  $('depth').oninput = () => isReady && sendDepth(Number($('depth').value));
  $('color').onchange = () => isReady && ask('color', { name: $('color').value }).catch(failed);
  $('body').onchange = () => $('body').value && chosen(openBody($('body').value));
  hear('open', () => $('file').click());
  $('file').onchange = () => {
    chosen(openFiles([...$('file').files]));
    $('file').value = ''; // the same file may be opened again
  };
  addEventListener('keydown', onKey);
  addEventListener('dragover', (event) => (event.preventDefault(), document.body.classList.add('dropping')));
  addEventListener('dragleave', (event) => event.relatedTarget ?? document.body.classList.remove('dropping'));
  addEventListener('drop', (event) => {
    event.preventDefault();
    document.body.classList.remove('dropping');
    chosen(openFiles([...event.dataTransfer.files]));
  });
  document.addEventListener('visibilitychange', () => keeper.engine?.send({ type: 'shown', isShown: !document.hidden }));
}

// --- frames

function endReplay() {
  opened.isReplay = false;
  $('replay').hidden = true;
  say(hintOf(tool));
}

function onFrame({ detail }) {
  if (detail.surface) measured.triangles = detail.surface.positions.length / 9;
  Object.assign(measured, { figures: detail.figures, isAwake: detail.isAwake, isReplay: detail.isReplay });
  if (detail.place) $('progress').value = detail.place.call / Math.max(1, detail.place.calls);
  hasFrame = true;
  panel.take(detail.figures);
  frames.take(detail);
}

function onDrawn({ detail }) {
  ++measured.frames;
  measured.drawMs = detail.ms;
  frames.pass();
  if (!hasFrame || !detail.hasBody || measured.state === 'covered') return;
  measured.state = 'ready';
  measured.cuttableMs ??= performance.now();
}

function onReplayed({ detail }) {
  measured.replayed = detail;
  const isSame = detail.verdict.startsWith('End: the same');
  endReplay();
  say(isSame ? 'Played: the same state as was recorded, bit for bit. Go on by hand.' : `Played. ${detail.verdict}`, 10);
}

const heightOf = (what) => document.querySelector(what).offsetHeight;
const sizeOfView = () => {
  const { innerWidth: width, innerHeight: height } = window;
  const controls = 2 * Math.max(heightOf('header'), heightOf('footer'));
  return [width, height, Math.max(height / 3, height - controls)];
};
const sendSize = newest((size) => ask('resize', size).catch(failed));

/** Panels keep clear of the controls, where there is room. */
function leaveRoom() {
  for (const what of ['header', 'footer']) document.documentElement.style.setProperty(`--${what}`, `${heightOf(what)}px`);
}

function fit() {
  leaveRoom();
  const size = sizeOfView();
  drawing?.resize([size[0], size[1], devicePixelRatio]);
  if (keeper.engine) sendSize(size);
}

/** The longest times for which the page did not answer: while it loaded, and once it could be cut. */
function watchBlocks() {
  if (!PerformanceObserver.supportedEntryTypes?.includes('longtask')) return;
  new PerformanceObserver((list) => {
    for (const { startTime, duration } of list.getEntries()) {
      const when = startTime > (measured.cuttableMs ?? Infinity) ? 'longestBlockMs' : 'longestBlockLoadingMs';
      measured[when] = Math.max(measured[when], duration);
    }
  }).observe({ type: 'longtask', buffered: true });
}

// --- beginning

function startEngine() {
  const hear = (type, what) => keeper.addEventListener(type, what);
  hear('loaded', onLoaded);
  hear('warm', () => openings === 0 && openSome()); // else what was chosen meanwhile is opened
  hear('frame', onFrame);
  hear('replayed', onReplayed);
  hear('failed', ({ detail }) => failed(detail.error));
  hear('dead', ({ detail }) => {
    isReady = false;
    measured.state = 'replacing';
    measured.deathNoticed = performance.timeOrigin + performance.now();
    say(`The engine stopped (${detail.error.message}). Another one is starting.`);
  });
  hear('resumed', ({ detail }) => onResumed(detail).catch(failed));
  hear('lost', ({ detail }) => {
    isReady = false;
    const again = button('Start again', () => location.reload());
    const noConnection = 'There is no connection to fetch it: start again when there is one.';
    if (detail.error.code === 'BadFile') return cover('The engine could not be fetched.', navigator.onLine ? `The server did not send it: ${detail.error.message.replace('; see locateFile', '')}.` : noConnection, ...savers(), again);
    const remedy = navigator.onLine ? 'It was started again, and stopped again. A smaller mesh may help.' : noConnection;
    cover(`The engine stopped: ${detail.error.message}`, remedy, ...savers(), again);
  });
  keeper.start();
}

async function onResumed({ info, isWhole }) {
  take(info, opened.id);
  const resumed = opened;
  await setUp();
  ++measured.replacements;
  if (opened !== resumed) return; // something else has been chosen
  if (isWhole) return say('The engine stopped and was started again. All that was done is here.', 12);
  say('The engine stopped and was started again: here is the body as it was opened. ');
  $('hint').append(...savers());
}

function onLoaded({ detail }) {
  measured.version = detail.version;
  measured.loadedMs = performance.now();
  fit();
  if (drawing) return setTheme(theme).catch(failed);
  startDrawing(detail.look);
  setTheme(theme).catch(failed);
}

function onUnable(why) {
  if (why) return cover(`The drawing stopped: ${why}`, 'It was started again, and stopped again. Load the page anew, or use another browser.');
  cover('This browser offers no WebGL 2, with which Incise draws.', 'Turn hardware acceleration on in its settings, or use a current Firefox, Chrome, Edge or Safari.');
}

function startDrawing(look) {
  const [width, height] = sizeOfView(), wanted = new URLSearchParams(location.search).get('look');
  const level = ['full', 'plain', 'coarse'].find((each) => each === wanted); // by itself as good as the machine can draw it
  drawing = new Drawing($('picture'), { look, size: [width, height, devicePixelRatio], level });
  frames = new Frames(drawing, () => isReady && want());
  const hear = (type, what) => drawing.addEventListener(type, what);
  hear('drawn', onDrawn);
  hear('begun', ({ detail }) => {
    frames.restMs = detail.isSoftware ? REST_MS : 0;
    Object.assign(measured, { renderer: detail.renderer, level: detail.level });
  });
  hear('level', ({ detail }) => (measured.level = detail.level));
  hear('lost', () => say('The picture was lost; it comes back by itself.'));
  hear('restored', () => say('The picture is back.', 3));
  hear('replaced', () => {
    ++measured.drawingReplaced;
    want(true);
  });
  hear('unable', ({ detail }) => onUnable(detail.why));
}

async function openFirst() {
  let isDamaged = false;
  try {
    const found = await fromFragment(location.hash);
    if (found) return await openLink(found);
  } catch {
    isDamaged = true;
  }
  const id = new URLSearchParams(location.search).get('body') ?? bodies[0].id;
  await openBody(id);
  if (!bodies.some((each) => each.id === id)) say(`No body here is called ${id}: this is the first of the list.`, 12);
  if (isDamaged) say('The link is damaged: it may have been cut off. Here is a fresh body.', 12);
}

/** Opens what the page begins with; again, where the engine died meanwhile. */
async function openSome() {
  while (!hasOpened) {
    try {
      return await openFirst();
    } catch (error) {
      if (error.code !== 'Ended') return failed(error);
    }
  }
}

/** Tells of a choice that fails; where it came before any body was there the page's first one is opened. */
const chosen = (opening) => opening.catch(async (error) => {
  await openSome();
  failed(error);
});

/** The address has another link. */
async function openLater() {
  const found = await fromFragment(location.hash).catch(() => say('The link is damaged: it may have been cut off.', 12));
  if (found) await openLink(found);
}

function begin() {
  setTheme(firstTheme()); // no engine is asked yet
  if (typeof WebAssembly !== 'object') {
    return cover('This browser has no WebAssembly, in which Incise computes.', 'Use a current Firefox, Chrome, Edge or Safari, or allow WebAssembly in its settings.');
  }
  for (const body of bodies) $('body').append(new Option(body.name, body.id));
  makeTools();
  hearControls();
  const sendEvents = batches(() => hands.take().filter(() => isReady), (events) => ask('events', events).catch(() => {}), requestAnimationFrame);
  hands = new Hands($('picture'), () => {
    measured.mostWaiting = Math.max(measured.mostWaiting, keeper.engine?.waiting ?? 0);
    sendEvents();
  });
  keyHand = new KeyHand($('picture'), $('cross'), hands);
  watchBlocks();
  startEngine();
  addEventListener('resize', fit);
  addEventListener('hashchange', () => chosen(openLater()));
  setInterval(() => panel.refresh().catch(failed), 1000);
}

begin();
