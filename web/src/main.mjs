// SPDX-License-Identifier: Apache-2.0
// The page: controls, files and links around a session that runs in a worker.
import { SessionWorker } from 'incise/worker';
import { drawHistogram } from './histogram.mjs';
import { Hands } from './hands.mjs';
import { icon } from './icons.mjs';
import { LONGEST_LINK, fromFragment, toFragment } from './link.mjs';
import { Picture } from './picture.mjs';
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
const LARGEST_FILE = 200e6; // bytes; a mesh of some two million tets

/** For tests and the curious: what the page measured of itself. */
const measured = (window.incise = { state: 'loading', failures: [], frames: 0, longestBlockMs: 0, longestBlockLoadingMs: 0, drawMs: 0 });

let engine, picture, hands, look, tool = 'Scalpel', theme, isReady = false, hasFrame = false;
let opened = { id: '', isReplay: false }, hintTimer = 0, shownAt = 0;

function say(text, seconds = 0) {
  $('hint').textContent = text;
  clearTimeout(hintTimer);
  if (seconds > 0) hintTimer = setTimeout(() => say(TOOLS.find((each) => each.name === tool).hint), 1000 * seconds);
}

/** Instead of the page: why it cannot work, and what to do. */
function cover(text, remedy, label, action) {
  measured.state = 'covered';
  const lines = [text, remedy].map((line) => Object.assign(document.createElement('p'), { textContent: line }));
  $('cover').replaceChildren(...lines);
  if (label) $('cover').append(Object.assign(document.createElement('button'), { textContent: label, onclick: action }));
  $('cover').hidden = false;
}

function failed(error) {
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
  if (!picture) return;
  look = await engine.ask('look', { theme: next });
  picture.setLook(look);
  refreshFigures();
}

function firstTheme() {
  let kept = null;
  try {
    kept = localStorage.getItem('incise-theme');
  } catch { /* likewise */ }
  return kept ?? (matchMedia('(prefers-color-scheme: light)').matches ? 'light' : 'dark');
}

// --- bodies, files, links

async function fetchBytes(file) {
  const response = await fetch(new URL(`bodies/${file}`, document.baseURI));
  if (!response.ok) throw new Error(`${file}: the server answers ${response.status}`);
  return new Uint8Array(await response.arrayBuffer());
}

/** What a body's scene or recording names: its mesh, and its fine surface where it has one. */
async function fetchParts(body) {
  const names = [body.model ?? (body.file.endsWith('.json') ? null : body.file), body.surface].filter(Boolean);
  const files = await Promise.all(names.map(async (name) => [name, await fetchBytes(name)]));
  return Object.fromEntries(files);
}

async function open(what, id) {
  say('Opening…');
  measured.state = 'opening';
  const info = await engine.ask('open', what);
  opened = { id, isReplay: info.isReplay };
  measured.body = id;
  $('replay').hidden = !info.isReplay;
  isReady = true;
  await engine.ask('tool', { name: tool });
  await engine.ask('depth', { share: Number($('depth').value) });
  if (info.isReplay) say('Playing the recording of a link or file.');
  else say(`${info.tets.toLocaleString('en')} tets. ${TOOLS.find((each) => each.name === tool).hint}`);
  hasFrame = false;
  engine.send({ type: 'want' });
  refreshFigures();
}

async function openBody(id) {
  const body = bodies.find((each) => each.id === id) ?? bodies[0];
  const files = body.model ? await fetchParts(body) : undefined;
  await open({ bytes: await fetchBytes(body.file), name: body.file, files, up: body.up }, body.id);
  $('body').value = body.id;
}

async function openFile(file) {
  if (file.size > LARGEST_FILE) throw new Error(`${file.name} is larger than ${LARGEST_FILE / 1e6} MB; use the window or the command`);
  const bytes = new Uint8Array(await file.arrayBuffer());
  const body = bodies.find((each) => each.id === opened.id);
  const files = body ? await fetchParts(body) : {};
  delete files[file.name];
  await open({ bytes, name: file.name, files }, '');
  own(file.name);
}

/** Shows a body that is no row of the list. */
function own(name) {
  const option = $('body').querySelector('option[value=""]') ?? new Option('', '');
  option.textContent = name;
  $('body').append(option);
  $('body').value = '';
}

async function openLink(found) {
  const body = bodies.find((each) => each.id === found.body);
  const files = body ? await fetchParts(body) : undefined;
  await open({ bytes: found.recording, name: 'link.jsonl', files }, body?.id ?? '');
  if (body) $('body').value = body.id;
}

async function share() {
  const recording = await engine.ask('recording');
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

/** The picture with the page's ground behind it. */
function screenshot() {
  picture.draw();
  const source = picture.renderer.domElement;
  const sheet = Object.assign(document.createElement('canvas'), { width: source.width, height: source.height });
  const pen = sheet.getContext('2d');
  const ground = pen.createLinearGradient(0, 0, 0, sheet.height);
  const style = getComputedStyle(document.documentElement);
  ground.addColorStop(0, style.getPropertyValue('--top'));
  ground.addColorStop(1, style.getPropertyValue('--bottom'));
  pen.fillStyle = ground;
  pen.fillRect(0, 0, sheet.width, sheet.height);
  pen.drawImage(source, 0, 0);
  sheet.toBlob((blob) => save(blob, 'incise.png'));
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
  engine.ask('tool', { name }).catch(failed);
  say(TOOLS.find((each) => each.name === name).hint);
}

async function act(what) {
  if (!isReady) return;
  const done = await engine.ask(what).catch(failed);
  if (done === false && what !== 'cancel') say(what === 'undo' ? 'Nothing to take back.' : 'Nothing to make again.', 3);
  engine.send({ type: 'want' });
  setTimeout(refreshFigures, 50);
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
  for (const other of ['figures', 'help']) {
    $(other).hidden = other !== id || !isShown;
    $(`${other}-button`).setAttribute('aria-expanded', !$(other).hidden);
  }
  refreshFigures();
}

function changeDepth(by) {
  $('depth').value = Number($('depth').value) + by;
  $('depth').oninput();
}

const KEYS = {
  ...Object.fromEntries(TOOLS.map(({ name }, i) => [i + 1, () => choose(name)])),
  r: () => act('reset'), Home: () => act('frameBody'), Escape: () => act('cancel'),
  f: () => toggle('figures'), h: () => toggle('help'), '?': () => toggle('help'),
  t: () => setTheme(theme === 'dark' ? 'light' : 'dark'), '[': () => changeDepth(-0.04), ']': () => changeDepth(0.04),
};

function onKey(event) {
  if (event.target.matches('select, input')) return;
  const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
  if (event.ctrlKey || event.metaKey) {
    const what = key === 'z' ? (event.shiftKey ? 'redo' : 'undo') : key === 'y' ? 'redo' : null;
    if (!what) return;
    event.preventDefault();
    return act(what);
  }
  if (event.altKey || !KEYS[key]) return;
  event.preventDefault();
  KEYS[key]();
}

function hearControls() {
  const hear = (id, what) => ($(id).onclick = () => Promise.resolve(what()).catch(failed));
  for (const what of ['undo', 'redo', 'reset']) hear(what, () => act(what));
  hear('share', share);
  hear('shot', screenshot);
  hear('theme', () => setTheme(theme === 'dark' ? 'light' : 'dark'));
  hear('figures-button', () => toggle('figures'));
  hear('help-button', () => toggle('help'));
  hear('take-over', async () => {
    await engine.ask('takeOver');
    endReplay();
  });
  $('depth').oninput = () => isReady && engine.ask('depth', { share: Number($('depth').value) }).catch(failed);
  $('color').onchange = () => picture.setColorBy(Number($('color').value));
  $('body').onchange = () => $('body').value && openBody($('body').value).catch(failed);
  $('open-label').onkeydown = (event) => ['Enter', ' '].includes(event.key) && (event.preventDefault(), $('file').click());
  $('file').onchange = () => {
    const [file] = $('file').files;
    if (file) openFile(file).catch(failed);
    $('file').value = ''; // the same file may be opened again
  };
  addEventListener('keydown', onKey);
  addEventListener('dragover', (event) => (event.preventDefault(), document.body.classList.add('dropping')));
  addEventListener('dragleave', (event) => event.relatedTarget ?? document.body.classList.remove('dropping'));
  addEventListener('drop', (event) => {
    event.preventDefault();
    document.body.classList.remove('dropping');
    const [file] = event.dataTransfer.files;
    if (file) openFile(file).catch(failed);
  });
  document.addEventListener('visibilitychange', () => engine?.send({ type: 'shown', isShown: !document.hidden }));
}

// --- figures

const show = (id, text) => ($(id).textContent = text);

async function refreshFigures() {
  if (!isReady || $('figures').hidden) return;
  if (measured.figures) showFrame(measured.figures); // at rest no frames come
  const { now, before, pieces } = await engine.ask('quality');
  show('f-pieces', pieces);
  show('f-mean', `${before.lrMean.toFixed(2)} → ${now.lrMean.toFixed(2)}`);
  show('f-worst', `${before.lrMax.toFixed(1)} → ${now.lrMax.toFixed(1)}`);
  show('f-hash', await engine.ask('hash'));
  const style = getComputedStyle(document.documentElement);
  drawHistogram($('histogram'), before.histogram, now.histogram, style.getPropertyValue('--accent'), style.getPropertyValue('--text'));
}

function showFrame(figures) {
  if ($('figures').hidden) return;
  show('f-tets', `${figures.tetsAtStart.toLocaleString('en')} → ${figures.tets.toLocaleString('en')}`);
  show('f-strokes', figures.strokes);
  show('f-force', `${figures.force.toFixed(2)} N, peak ${figures.peakForce.toFixed(2)}`);
  show('f-frame', `${figures.frameMs.toFixed(1)} ms`);
  show('f-rate', `${figures.rate.toFixed(0)} frames/s`);
}

// --- frames

function endReplay() {
  opened.isReplay = false;
  $('replay').hidden = true;
  say(TOOLS.find((each) => each.name === tool).hint);
}

function onFrame({ detail }) {
  picture.take(detail);
  if (detail.surface) measured.triangles = detail.surface.positions.length / 9;
  Object.assign(measured, { state: 'ready', figures: detail.figures, isAwake: detail.isAwake, isReplay: detail.isReplay });
  if (detail.place) $('progress').value = detail.place.call / Math.max(1, detail.place.calls);
  if (!hasFrame) {
    hasFrame = true;
    measured.cuttableMs ??= performance.now();
  }
  if (performance.now() - shownAt > 200) {
    shownAt = performance.now();
    showFrame(detail.figures);
  }
}

function onReplayed({ detail }) {
  measured.replayed = detail;
  const isSame = detail.verdict.startsWith('End: the same');
  endReplay();
  say(isSame ? 'Played: the same state as was recorded, bit for bit. Go on by hand.' : `Played. ${detail.verdict}`, 10);
}

function animate() {
  if (measured.state !== 'covered') requestAnimationFrame(animate);
  if (!picture) return;
  const events = hands.take();
  if (events.length > 0 && isReady) engine.send({ type: 'events', events });
  if (picture.needsDraw) {
    const began = performance.now();
    picture.draw();
    measured.drawMs = performance.now() - began;
    ++measured.frames;
    if (isReady) engine.send({ type: 'want' });
  }
}

function fit() {
  const { innerWidth: width, innerHeight: height } = window;
  picture?.resize(width, height);
  const controls = 2 * Math.max(document.querySelector('header').offsetHeight, document.querySelector('footer').offsetHeight);
  engine?.send({ type: 'resize', size: [width, height, Math.max(height / 3, height - controls)] });
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
  engine = new SessionWorker();
  measured.engine = engine;
  engine.addEventListener('loaded', (event) => onLoaded(event).catch(failed));
  engine.addEventListener('warm', () => openFirst().catch(failed));
  engine.addEventListener('frame', onFrame);
  engine.addEventListener('replayed', onReplayed);
  engine.addEventListener('failed', ({ detail }) => failed(detail.error));
  engine.addEventListener('broken', ({ detail }) => {
    engine.end();
    isReady = false;
    cover('The engine stopped: ' + detail.error.message, 'What was cut is lost. A smaller mesh may help.', 'Start again', () => location.reload());
  });
}

async function onLoaded({ detail }) {
  measured.version = detail.version;
  measured.loadedMs = performance.now();
  if (!picture) {
    picture = new Picture($('picture'), detail.look);
    $('picture').addEventListener('webglcontextlost', (event) => {
      event.preventDefault();
      say('The picture was lost; it comes back by itself.');
    });
    $('picture').addEventListener('webglcontextrestored', () => {
      picture.needsDraw = true;
      say('The picture is back.', 3);
    });
  }
  fit();
  await setTheme(theme);
}

async function openFirst() {
  let isDamaged = false;
  try {
    const found = await fromFragment(location.hash);
    if (found) return await openLink(found);
  } catch {
    isDamaged = true;
  }
  await openBody(new URLSearchParams(location.search).get('body') ?? bodies[0].id);
  if (isDamaged) say('The link is damaged: it may have been cut off. Here is a fresh body.', 12);
}

function begin() {
  setTheme(firstTheme()); // no engine is asked yet
  if (typeof WebAssembly !== 'object') {
    return cover('This browser has no WebAssembly, in which Incise computes.', 'Use a current Firefox, Chrome, Edge or Safari, or allow WebAssembly in its settings.');
  }
  if (!document.createElement('canvas').getContext('webgl2')) {
    return cover('This browser offers no WebGL 2, with which Incise draws.', 'Turn hardware acceleration on in its settings, or use a current Firefox, Chrome, Edge or Safari.');
  }
  for (const body of bodies) $('body').append(new Option(body.name, body.id));
  makeTools();
  hearControls();
  hands = new Hands($('picture'));
  watchBlocks();
  startEngine();
  addEventListener('resize', fit);
  addEventListener('hashchange', () => openFirst().catch(failed));
  setInterval(() => refreshFigures().catch(failed), 1000);
  requestAnimationFrame(animate);
}

begin();
