// SPDX-License-Identifier: Apache-2.0
// The page in headless Chromium, with mouse and touch events as a person makes them. Pictures go to build/web-pictures.
import assert from 'node:assert/strict';
import { mkdirSync, writeFileSync } from 'node:fs';
import { gzipSync } from 'node:zlib';
import { after, before, beforeEach, afterEach, describe, test } from 'node:test';
import { at, executablePath, launch, read, serve } from './support.mjs';

const pictures = at('build/web-pictures');

describe('the page', { skip: executablePath ? false : 'Chromium is not installed: script/bootstrap --web' }, () => {
  let browser, server, page, complaints, failures;
  const fetched = new Set();

  before(async () => {
    mkdirSync(pictures, { recursive: true });
    server = await serve(at('build/site'));
    browser = await launch();
  });
  after(async () => {
    await browser?.close();
    server?.close();
  });
  beforeEach(() => {
    complaints = [];
    failures = 0;
  });
  afterEach(async () => {
    const found = await page?.evaluate(() => window.incise?.failures ?? []).catch(() => []);
    if (found && found.length !== failures) complaints.push(`${found.length} failures, expected ${failures}: ${found.join('; ')}`);
    await page?.context().close();
    page = null;
    assert.deepEqual(complaints, []);
  });

  async function openPage({ path = '', waits = true, script, ...options } = {}) {
    const context = await browser.newContext({ viewport: { width: 960, height: 640 }, acceptDownloads: true, ...options });
    page = await context.newPage();
    page.on('pageerror', (error) => complaints.push(String(error)));
    page.on('console', (message) => ['error', 'warning'].includes(message.type()) && !isOfDriver(message.text()) && complaints.push(message.text()));
    page.on('request', (request) => request.url().startsWith(`${server.url}`) && fetched.add(new URL(request.url()).pathname.replace(/\/$/, '/index.html')));
    page.on('request', (request) => new URL(request.url()).protocol === 'http:' && !request.url().startsWith(server.url) && complaints.push(`asks ${request.url()}`));
    if (script) await page.addInitScript(script);
    await page.goto(server.url + path);
    if (waits) await isReady();
    return page;
  }
  /** What a processor that draws says of itself, which no visitor's driver does. */
  const isOfDriver = (text) => /GPU stall due to ReadPixels|GL Driver Message/.test(text);
  const isReady = () => page.waitForFunction(() => window.incise?.state === 'ready', null, { timeout: 30_000 });
  const figures = () => page.evaluate(() => window.incise.figures);
  const ask = (what) => page.evaluate((name) => window.incise.engine.ask(name), what);
  const hint = () => page.locator('#hint').textContent();
  const until = (what, argument) => page.waitForFunction(what, argument, { timeout: 20_000 });
  const press = (keys) => page.keyboard.press(keys);
  const isAtRest = () => until(() => window.incise.isAwake === false);

  /** A drag by the mouse, in shares of the picture. */
  async function drag(from, to, { steps = 20, button = 'left', pause = 10 } = {}) {
    const { width, height } = page.viewportSize();
    const place = (t) => [0, 1].map((i) => (from[i] + (to[i] - from[i]) * t) * [width, height][i]);
    await page.mouse.move(...place(0));
    await page.mouse.down({ button });
    for (let i = 1; i <= steps; ++i) {
      await page.mouse.move(...place(i / steps));
      await page.waitForTimeout(pause);
    }
    await page.mouse.up({ button });
  }

  test('a drag cuts, a second one cuts on, and undo takes both back', async () => {
    await openPage();
    const whole = await figures();
    assert.equal(whole.tets, 5040);
    const hash = await ask('hash');
    await drag([0.4, 0.45], [0.55, 0.47]);
    await until(() => window.incise.figures.strokes === 1);
    const first = await figures();
    assert.ok(first.tets > whole.tets && first.cutTets > 0, JSON.stringify(first));
    await drag([0.55, 0.47], [0.66, 0.5]);
    await until((before) => window.incise.figures.strokes === 2 && window.incise.figures.cutTets > before, first.cutTets);
    assert.notEqual(await ask('hash'), hash);
    await press('Control+z');
    await until(() => window.incise.figures.strokes === 1);
    await page.click('#undo');
    await until(() => window.incise.figures.strokes === 0);
    assert.equal((await figures()).tets, 5040);
    await press('Control+y');
    await until(() => window.incise.figures.strokes === 1);
    await press('r');
    await until(() => window.incise.figures.strokes === 0 && window.incise.figures.frames < 100);
  });

  test('a plane cuts the body in two, and the forceps pull it open', async () => {
    await openPage();
    await press('3');
    await drag([0.5, 0.1], [0.52, 0.85]);
    await until(async () => (await window.incise.engine.ask('quality')).pieces === 2);
    const before = await page.screenshot();
    await press('5');
    assert.match(await hint(), /pull/);
    const { width, height } = page.viewportSize();
    await page.mouse.move(0.45 * width, 0.42 * height);
    await page.mouse.down();
    await page.mouse.move(0.35 * width, 0.3 * height, { steps: 20 });
    await page.waitForTimeout(800);
    const pulled = await page.screenshot({ path: `${pictures}/forceps.png` });
    await page.mouse.up();
    assert.notDeepEqual(pulled, before);
  });

  test('a retractor holds a lip aside, and a click lets it go', async () => {
    await openPage();
    await drag([0.36, 0.45], [0.62, 0.5], { steps: 20, pause: 16 });
    await until(() => window.incise.figures.strokes === 1);
    await press('6');
    await drag([0.48, 0.45], [0.46, 0.36], { steps: 20, pause: 16 });
    await page.waitForTimeout(600);
    await page.screenshot({ path: `${pictures}/retractor.png` });
    const recording = new TextDecoder().decode(Uint8Array.from(await page.evaluate(async () => [...await window.incise.engine.ask('recording')])));
    assert.match(recording, /"hook|hold/);
  });

  test('scissors cut where they close', async () => {
    await openPage();
    await press('4');
    await drag([0.42, 0.45], [0.58, 0.47], { steps: 20, pause: 16 });
    await until(() => window.incise.figures.cutTets > 0);
    await page.screenshot({ path: `${pictures}/scissors.png` });
  });

  test('every body of the list opens and is cut', async () => {
    await openPage();
    for (const { id } of JSON.parse(read('web/bodies.json'))) {
      await page.selectOption('#body', id);
      await until((name) => window.incise.body === name && window.incise.state === 'ready' && window.incise.figures.cutTets === 0, id);
      await page.screenshot({ path: `${pictures}/body_${id}.png` });
      await press('3');
      await drag([0.5, 0.15], [0.52, 0.8]);
      await until(() => window.incise.figures.cutTets > 0);
    }
  });

  test('one finger cuts, two turn the view and cut nothing', async () => {
    await openPage({ viewport: { width: 360, height: 740 }, hasTouch: true, isMobile: true });
    const devtools = await page.context().newCDPSession(page);
    const touch = (type, ...points) => devtools.send('Input.dispatchTouchEvent', { type, touchPoints: points.map(([x, y], id) => ({ x, y, id })) });
    await touch('touchStart', [140, 330]);
    for (let i = 1; i <= 20; ++i) {
      await touch('touchMove', [140 + 4 * i, 330 + i]);
      await page.waitForTimeout(10);
    }
    await touch('touchEnd');
    await until(() => window.incise.figures.strokes === 1 && window.incise.figures.cutTets > 0);
    await isAtRest();
    await page.screenshot({ path: `${pictures}/touch.png` });
    const { cutTets } = await figures();
    const before = await page.screenshot();
    await touch('touchStart', [20, 150]);
    await touch('touchStart', [20, 150], [60, 150]);
    for (let i = 1; i <= 10; ++i) await touch('touchMove', [20 + 6 * i, 150 + 2 * i], [60 + 10 * i, 150 + 2 * i]);
    await touch('touchEnd');
    await page.waitForTimeout(500);
    assert.notDeepEqual(await page.screenshot(), before);
    assert.equal((await figures()).cutTets, cutTets);
  });

  test('a link plays the session again and ends in the same state', async () => {
    await openPage();
    await drag([0.4, 0.45], [0.6, 0.5]);
    await until(() => window.incise.figures.strokes === 1);
    await isAtRest();
    await drag([0.5, 0.38], [0.5, 0.6]);
    await until(() => window.incise.figures.strokes === 2);
    await press('Control+z');
    await until(() => window.incise.figures.strokes === 1);
    await isAtRest();
    const hash = await ask('hash');
    await page.click('#share');
    await until(() => location.hash.includes('r='));
    const path = new URL(page.url()).hash;
    assert.ok(path.length < 60_000, `the link has ${path.length} characters`);
    await page.context().close();
    await openPage({ path });
    await until(() => window.incise.replayed);
    const replayed = await page.evaluate(() => window.incise.replayed);
    assert.equal(replayed.hash, hash);
    assert.match(await hint(), /bit for bit/);
    // It goes on by hand from there.
    await drag([0.4, 0.6], [0.6, 0.6]);
    await until(() => window.incise.figures.strokes === 2);
  });

  test('a damaged link opens a fresh body and says so', async () => {
    await openPage({ path: '#b=patch&r=AAAA' });
    assert.equal((await figures()).tets, 5040);
    assert.match(await hint(), /damaged/);
  });

  test('a mesh of one\'s own is opened, and a bad one is refused with its line', async () => {
    failures = 2;
    await openPage();
    await page.setInputFiles('#file', { name: 'mine.mesh', mimeType: 'text/plain', buffer: read('models/bunny.mesh') });
    await until(() => window.incise.figures.tetsAtStart === 10668);
    assert.match(await page.locator('#body option:checked').textContent(), /mine\.mesh/);
    await page.setInputFiles('#file', { name: 'bad.mesh', mimeType: 'text/plain', buffer: read('models/bunny.mesh').subarray(0, 9000) });
    await until(() => /bad\.mesh:\d+/.test(document.getElementById('hint').textContent));
    assert.equal((await figures()).tetsAtStart, 10668); // what was there is there still
    await page.setInputFiles('#file', { name: 'letter.txt', mimeType: 'text/plain', buffer: Buffer.from('Dear reader') });
    await until(() => /letter\.txt/.test(document.getElementById('hint').textContent));
    await drag([0.45, 0.5], [0.6, 0.55]);
    await until(() => window.incise.figures.strokes === 1);
    const [download] = await Promise.all([page.waitForEvent('download'), page.click('#share')]);
    assert.equal(download.suggestedFilename(), 'incise-recording.jsonl');
  });

  test('a dropped file is opened', async () => {
    await openPage();
    const data = await page.evaluateHandle((text) => {
      const transfer = new DataTransfer();
      transfer.items.add(new File([text], 'dropped.mesh'));
      return transfer;
    }, read('models/cube.mesh').toString());
    await page.dispatchEvent('#picture', 'drop', { dataTransfer: data });
    await until(() => window.incise.figures.tetsAtStart === 750);
  });

  test('figures, themes, picture and keys', async () => {
    await openPage({ colorScheme: 'light' });
    assert.equal(await page.getAttribute('html', 'data-theme'), 'light');
    await press('t');
    assert.equal(await page.getAttribute('html', 'data-theme'), 'dark');
    await isAtRest();
    await press('f');
    const hash = await ask('hash');
    await until((now) => document.getElementById('f-hash').textContent === now, hash);
    const empty = await page.evaluate(() => [...document.querySelectorAll('#figures dd')].filter((each) => !each.textContent).map((each) => each.id));
    assert.deepEqual(empty, []);
    await press('h');
    assert.equal(await page.locator('#figures').isVisible(), false);
    assert.equal(await page.locator('#help').isVisible(), true);
    const [download] = await Promise.all([page.waitForEvent('download'), page.click('#shot')]);
    assert.equal(download.suggestedFilename(), 'incise.png');
    await press('7');
    assert.equal(await page.getAttribute('[data-tool="Pin"]', 'aria-checked'), 'true');
    const unnamed = await page.evaluate(() => [...document.querySelectorAll('button, select, input:not([hidden])')].filter((each) => !(each.textContent.trim() || each.labels?.length)).map((each) => each.id));
    assert.deepEqual(unnamed, []);
  });

  test('a lost picture comes back', async () => {
    await openPage();
    await page.evaluate(() => {
      const context = document.getElementById('picture').getContext('webgl2');
      window.lost = context.getExtension('WEBGL_lose_context');
      window.lost.loseContext();
    });
    await until(() => /lost/.test(document.getElementById('hint').textContent));
    await page.evaluate(() => window.lost.restoreContext());
    await until(() => /back/.test(document.getElementById('hint').textContent));
    await drag([0.4, 0.45], [0.6, 0.5]);
    await until(() => window.incise.figures.strokes === 1);
    await page.screenshot({ path: `${pictures}/restored.png` });
    complaints = complaints.filter((text) => !/Context (Lost|Restored)|CONTEXT_LOST/i.test(text));
  });

  test('a worker that dies is told of, with a way out', async () => {
    await openPage();
    await page.workers()[0].evaluate(() => void setTimeout(() => { throw new Error('memory is out'); }));
    await page.locator('#cover').getByText(/memory is out/).waitFor();
    complaints = complaints.filter((text) => !/memory is out/.test(text));
    await page.locator('#cover button').click();
    await isReady();
    assert.equal((await figures()).tets, 5040);
  });

  test('without WebAssembly or WebGL 2 there is a message and no blank page', async () => {
    await openPage({ waits: false, script: 'delete globalThis.WebAssembly' });
    assert.match(await page.locator('#cover').textContent(), /no WebAssembly/);
    await page.context().close();
    await openPage({ waits: false, script: 'HTMLCanvasElement.prototype.getContext = () => null' });
    assert.match(await page.locator('#cover').textContent(), /WebGL 2/);
  });

  test('nothing overflows from 360 to 2560 pixels, dark and light', async () => {
    for (const [width, height] of [[360, 740], [1280, 800], [2560, 1440]]) {
      for (const colorScheme of ['dark', 'light']) {
        await openPage({ viewport: { width, height }, colorScheme });
        await drag([0.42, 0.42], [0.62, 0.5]);
        await until(() => window.incise.figures.strokes === 1);
        await isAtRest();
        await page.screenshot({ path: `${pictures}/${width}-${colorScheme}.png` });
        const outside = await page.evaluate(() => [...document.querySelectorAll('button, select, input:not([hidden]), h1')]
          .filter((each) => {
            const box = each.getBoundingClientRect();
            return box.width > 0 && (box.left < 0 || box.right > innerWidth || box.top < 0 || box.bottom > innerHeight);
          }).map((each) => each.id || each.textContent));
        assert.deepEqual(outside, [], `${width} px`);
        await press('f');
        await until(() => document.getElementById('f-pieces').textContent === '1');
        await page.screenshot({ path: `${pictures}/${width}-${colorScheme}-figures.png` });
        await page.context().close();
      }
    }
  });

  test('a body comes to rest, and nothing is computed or drawn then', async () => {
    await openPage();
    await isAtRest();
    const counts = () => page.evaluate(() => [window.incise.figures.frames, window.incise.frames]);
    const before = await counts();
    await page.waitForTimeout(500);
    assert.deepEqual(await counts(), before);
  });

  test('the session goes on when the window is resized', async () => {
    await openPage();
    await page.setViewportSize({ width: 500, height: 800 });
    await drag([0.4, 0.45], [0.6, 0.5]);
    await until(() => window.incise.figures.strokes === 1);
  });

  test('memory does not grow over strokes that are taken back', async () => {
    await openPage();
    const round = async (count) => {
      for (let i = 0; i < count; ++i) {
        await drag([0.42, 0.45], [0.56, 0.48], { steps: 5, pause: 16 });
        await until(() => window.incise.figures.strokes === 1);
        await press('Control+z');
        await until(() => window.incise.figures.strokes === 0);
      }
      return page.evaluate(() => (globalThis.gc?.(), performance.memory.usedJSHeapSize));
    };
    const early = await round(6), late = await round(process.env.INCISE_WEB_ALL ? 194 : 12); // two hundred take minutes
    assert.ok(late < early + 8e6, `${early} bytes became ${late}`);
  });

  test('a fine skin is drawn over a coarse body and cut with it', async () => {
    await openPage({ path: '?body=kidney' });
    const drawn = () => page.evaluate(() => window.incise.triangles);
    const whole = await figures(), skin = await drawn();
    assert.ok(skin > 10_000 && whole.tets < 3000, `${skin} triangles over ${whole.tets} tets`);
    await drag([0.47, 0.3], [0.5, 0.55], { steps: 30, pause: 16 });
    await until(() => window.incise.figures.strokes === 1 && window.incise.figures.cutTets > 0);
    await until((before) => window.incise.triangles > before + 20, skin);
    await isAtRest();
    await page.screenshot({ path: `${pictures}/fine_cut.png` });
    await press('3');
    await drag([0.5, 0.1], [0.52, 0.9]);
    await until(async () => (await window.incise.engine.ask('quality')).pieces > 1);
    await page.screenshot({ path: `${pictures}/fine_halves.png` });
    for (let i = 0; i < 2; ++i) await press('Control+z');
    await until((before) => window.incise.figures.strokes === 0 && window.incise.triangles === before, skin);
  });

  test('figures of the page', async (context) => {
    const measured = [];
    for (const body of ['patch', 'bunny', 'kidney']) {
      fetched.clear();
      await openPage({ path: `?body=${body}` });
      await page.waitForTimeout(500);
      const settled = await page.evaluate(() => ({ simulated: window.incise.figures.frames, drawn: window.incise.frames }));
      const began = Date.now();
      await drag([0.4, 0.5], [0.62, 0.55], { steps: 60, pause: 16 });
      const seconds = (Date.now() - began) / 1000;
      const found = await page.evaluate(() => ({ ...window.incise, engine: undefined }));
      measured.push({
        gzippedBytes: [...fetched].reduce((sum, path) => sum + gzipSync(read('build/site', path)).length, 0),
        tets: found.figures.tetsAtStart, cuttableMs: Math.round(found.cuttableMs),
        simulatedPerSecond: Math.round((found.figures.frames - settled.simulated) / seconds),
        drawnPerSecond: Math.round((found.frames - settled.drawn) / seconds),
        longestBlockMs: found.longestBlockMs, longestBlockLoadingMs: found.longestBlockLoadingMs,
        longestFrameMs: Math.round(found.figures.longestFrameMs),
      });
      assert.ok(fetched.size >= 6 && measured.at(-1).gzippedBytes <= 1.5e6, `${measured.at(-1).gzippedBytes} bytes`);
      assert.ok(found.cuttableMs > 0 && found.figures.cutTets > 0);
      await page.context().close();
    }
    writeFileSync(`${pictures}/figures.json`, JSON.stringify(measured, null, 1));
    context.diagnostic(JSON.stringify(measured));
  });
});
