// SPDX-License-Identifier: Apache-2.0
// The page in headless Chromium, with mouse and touch events as a person makes them. Pictures go to build/web-pictures.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { describe, test } from 'node:test';
import { Visit, pictures, skip } from './page_support.mjs';
import { launch, read } from './support.mjs';

describe('the page', { skip }, () => {
  const visit = new Visit();
  const { ask, drag, figures, hint, isAtRest, isReady, openPage, press, until } = visit;

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
    await visit.page.click('#undo');
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
    const before = await visit.page.screenshot();
    await press('5');
    assert.match(await hint(), /pull/);
    const { width, height } = visit.page.viewportSize();
    await visit.page.mouse.move(0.45 * width, 0.42 * height);
    await visit.page.mouse.down();
    await visit.page.mouse.move(0.35 * width, 0.3 * height, { steps: 20 });
    await visit.page.waitForTimeout(800);
    const pulled = await visit.page.screenshot({ path: `${pictures}/forceps.png` });
    await visit.page.mouse.up();
    assert.notDeepEqual(pulled, before);
  });

  test('a retractor holds a lip aside, and a click lets it go', async () => {
    await openPage();
    await drag([0.36, 0.45], [0.62, 0.5], { steps: 20, pause: 16 });
    await until(() => window.incise.figures.strokes === 1);
    await press('6');
    await drag([0.48, 0.45], [0.46, 0.36], { steps: 20, pause: 16 });
    await visit.page.waitForTimeout(600);
    await visit.page.screenshot({ path: `${pictures}/retractor.png` });
    const recording = new TextDecoder().decode(Uint8Array.from(await visit.page.evaluate(async () => [...await window.incise.engine.ask('recording')])));
    assert.match(recording, /"hook|hold/);
  });

  test('scissors cut where they close', async () => {
    await openPage();
    await press('4');
    await drag([0.42, 0.45], [0.58, 0.47], { steps: 20, pause: 16 });
    await until(() => window.incise.figures.cutTets > 0);
    await visit.page.screenshot({ path: `${pictures}/scissors.png` });
  });

  test('every body of the list opens and is cut', async () => {
    await openPage({ path: '?look=full' });
    for (const { id } of JSON.parse(read('web/bodies.json'))) {
      await visit.page.selectOption('#body', id);
      await until((name) => window.incise.body === name && window.incise.state === 'ready' && window.incise.figures.cutTets === 0, id);
      await visit.page.screenshot({ path: `${pictures}/body_${id}.png` });
      await press('3');
      await drag([0.5, 0.15], [0.52, 0.8]);
      await until(() => window.incise.figures.cutTets > 0);
    }
  });

  test('one finger cuts, two turn the view and cut nothing', async () => {
    await openPage({ viewport: { width: 360, height: 740 }, hasTouch: true, isMobile: true });
    const devtools = await visit.page.context().newCDPSession(visit.page);
    const touch = (type, ...points) => devtools.send('Input.dispatchTouchEvent', { type, touchPoints: points.map(([x, y], id) => ({ x, y, id })) });
    await touch('touchStart', [140, 330]);
    for (let i = 1; i <= 20; ++i) {
      await touch('touchMove', [140 + 4 * i, 330 + i]);
      await visit.page.waitForTimeout(10);
    }
    await touch('touchEnd');
    await until(() => window.incise.figures.strokes === 1 && window.incise.figures.cutTets > 0);
    await isAtRest();
    await visit.page.screenshot({ path: `${pictures}/touch.png` });
    const { cutTets } = await figures();
    const before = await visit.page.screenshot();
    await touch('touchStart', [20, 150]);
    await touch('touchStart', [20, 150], [60, 150]);
    for (let i = 1; i <= 10; ++i) await touch('touchMove', [20 + 6 * i, 150 + 2 * i], [60 + 10 * i, 150 + 2 * i]);
    await touch('touchEnd');
    await visit.page.waitForTimeout(500);
    assert.notDeepEqual(await visit.page.screenshot(), before);
    assert.equal((await figures()).cutTets, cutTets);
  });

  test('a pen that presses lightly cuts less deep', async () => {
    const cutBy = async (force) => {
      await openPage();
      await visit.page.evaluate(() => document.getElementById('depth').focus());
      for (let i = 0; i < 20; ++i) await press('ArrowRight'); // deep enough to tell the two apart
      const devtools = await visit.page.context().newCDPSession(visit.page);
      const pen = (type, x, y) => devtools.send('Input.dispatchMouseEvent', { type, x, y, button: 'left', buttons: 1, clickCount: 1, pointerType: 'pen', force });
      await pen('mousePressed', 400, 290);
      for (let i = 1; i <= 20; ++i) {
        await pen('mouseMoved', 400 + 8 * i, 290 + i);
        await visit.page.waitForTimeout(16);
      }
      await pen('mouseReleased', 560, 310);
      await until(() => window.incise.figures.strokes === 1);
      await isAtRest();
      const { cutTets } = await figures();
      await visit.end();
      return cutTets;
    };
    const light = await cutBy(0.25), hard = await cutBy(1);
    assert.ok(light > 0 && hard > 1.3 * light, `${light} tets lightly, ${hard} hard`);
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
    await visit.page.click('#share');
    await until(() => location.hash.includes('r='));
    const path = new URL(visit.page.url()).hash;
    assert.ok(path.length < 60_000, `the link has ${path.length} characters`);
    await visit.page.context().close();
    await openPage({ path });
    await until(() => window.incise.replayed);
    const replayed = await visit.page.evaluate(() => window.incise.replayed);
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
    visit.failures = 2;
    await openPage();
    await visit.page.setInputFiles('#file', { name: 'mine.mesh', mimeType: 'text/plain', buffer: read('models/bunny.mesh') });
    await until(() => window.incise.figures.tetsAtStart === 10668);
    assert.match(await visit.page.locator('#body option:checked').textContent(), /mine\.mesh/);
    await visit.page.setInputFiles('#file', { name: 'bad.mesh', mimeType: 'text/plain', buffer: read('models/bunny.mesh').subarray(0, 9000) });
    await until(() => /bad\.mesh:\d+/.test(document.getElementById('hint').textContent));
    assert.equal((await figures()).tetsAtStart, 10668); // what was there is there still
    await visit.page.setInputFiles('#file', { name: 'letter.txt', mimeType: 'text/plain', buffer: Buffer.from('Dear reader') });
    await until(() => /letter\.txt/.test(document.getElementById('hint').textContent));
    await drag([0.45, 0.5], [0.6, 0.55]);
    await until(() => window.incise.figures.strokes === 1);
    await isAtRest();
    const hash = await ask('hash');
    const [download] = await Promise.all([visit.page.waitForEvent('download'), visit.page.click('#share')]);
    assert.equal(download.suggestedFilename(), 'incise-recording.jsonl');
    const saved = { name: 'saved.jsonl', mimeType: 'text/plain', buffer: readFileSync(await download.path()) };
    // While its mesh is open it is known; on a page that has another body it is asked for, and taken with the recording.
    await visit.page.setInputFiles('#file', saved);
    await until((end) => window.incise.replayed?.hash === end, hash);
    await visit.page.selectOption('#body', 'skin');
    await until(() => window.incise.body === 'skin' && window.incise.state === 'ready');
    visit.failures = 3;
    await visit.page.setInputFiles('#file', saved);
    await until(() => /saved\.jsonl names mine\.mesh: choose these files together/.test(document.getElementById('hint').textContent));
    assert.equal((await figures()).tetsAtStart, await visit.page.evaluate(() => window.incise.tets)); // the skin is there still
    await visit.page.evaluate(() => (window.incise.replayed = undefined));
    await visit.page.setInputFiles('#file', [{ name: 'mine.mesh', mimeType: 'text/plain', buffer: read('models/bunny.mesh') }, saved]);
    await until((end) => window.incise.replayed?.hash === end, hash);
    assert.match(await visit.page.locator('#body option:checked').textContent(), /saved\.jsonl/);
  });

  test('a recording of a body of the page needs nothing but itself, and a link is not made of a part', async () => {
    await openPage({ path: '?body=bunny' });
    await drag([0.45, 0.5], [0.6, 0.55]);
    await until(() => window.incise.figures.strokes === 1);
    await isAtRest();
    const hash = await ask('hash'), recording = await visit.page.evaluate(async () => [...(await window.incise.engine.ask('recording'))]);
    await openPage();
    await visit.page.setInputFiles('#file', { name: 'bunny.jsonl', mimeType: 'text/plain', buffer: Buffer.from(recording) });
    await until(() => window.incise.isReplay);
    await visit.page.click('#share');
    assert.match(await hint(), /a link of now would hold a part|bit for bit/);
    await until((end) => window.incise.replayed?.hash === end, hash);
  });

  test('what is asked of the page while it loads is answered in words', async () => {
    await openPage({ path: '?body=nothing', waits: false });
    await visit.page.click('#share');
    await visit.page.click('#shot');
    await press('f');
    await visit.isReady();
    assert.match(await hint(), /No body here is called nothing/);
  });

  test('a dropped file is opened', async () => {
    await openPage();
    const data = await visit.page.evaluateHandle((text) => {
      const transfer = new DataTransfer();
      transfer.items.add(new File([text], 'dropped.mesh'));
      return transfer;
    }, read('models/cube.mesh').toString());
    await visit.page.dispatchEvent('#picture', 'drop', { dataTransfer: data });
    await until(() => window.incise.figures.tetsAtStart === 750);
  });

  /** A file for the page's own field. */
  const file = (name, path) => ({ name, mimeType: 'text/plain', buffer: read(path) });

  test('a scene opens together with the mesh that it names in a folder, and goes from the list with the next body', async () => {
    visit.failures = 1;
    await openPage();
    const scene = { ...JSON.parse(read('scenes/web_meat.json')), model: { file: 'C:\\data\\own.mesh' } };
    const ofScene = { name: 'own.json', mimeType: 'text/plain', buffer: Buffer.from(JSON.stringify(scene)) };
    await visit.page.setInputFiles('#file', ofScene);
    await until(() => /^That did not work: own\.json names own\.mesh: choose these files together/.test(document.getElementById('hint').textContent));
    await visit.page.setInputFiles('#file', [ofScene, file('own.mesh', 'models/meat.mesh'), file('more.mesh', 'models/cube.mesh')]);
    await until(() => /Left out: more\.mesh/.test(document.getElementById('hint').textContent));
    assert.match(await visit.page.locator('#body option:checked').textContent(), /own\.json/);
    await visit.page.selectOption('#body', 'skin');
    await until(() => window.incise.body === 'skin' && window.incise.state === 'ready');
    assert.equal(await visit.page.locator('#body option[value=""]').count(), 0);
  });

  test('what is chosen last is shown, whatever comes late, and while the page loads, too', async () => {
    const context = await openPage({ waits: false });
    await visit.page.setInputFiles('#file', file('early.mesh', 'models/cube.mesh'));
    await until(() => window.incise.state === 'ready' && window.incise.figures.tetsAtStart === 750);
    await context.route('**/bodies/bunny.mesh', async (route) => {
      await new Promise((resolve) => setTimeout(resolve, 1000));
      await route.continue();
    });
    const late = visit.page.waitForResponse(/bunny\.mesh/);
    await visit.page.selectOption('#body', 'bunny');
    await visit.page.setInputFiles('#file', file('own.mesh', 'models/cube.mesh'));
    await (await late).finished();
    await visit.page.waitForTimeout(500);
    assert.equal((await figures()).tetsAtStart, 750);
    assert.match(await visit.page.locator('#body option:checked').textContent(), /own\.mesh/);
    visit.failures = 1;
    await context.route('**/bodies/**', (route) => route.abort());
    await visit.page.selectOption('#body', 'skin');
    await until(() => /no connection; your own files still open/.test(document.getElementById('hint').textContent));
    visit.complaints = visit.complaints.filter((text) => !/ERR_FAILED/.test(text));
  });

  test('a body chosen before the first one that cannot be opened leaves the first one', async () => {
    visit.failures = 1;
    await openPage({ waits: false });
    await visit.page.setInputFiles('#file', { name: 'letter.txt', mimeType: 'text/plain', buffer: Buffer.from('Dear reader') });
    await until(() => /letter\.txt/.test(document.getElementById('hint').textContent));
    await isReady();
    assert.equal((await figures()).tets, 5040);
  });

  test('the colour of the scene comes back, a wheel turns by what it is turned, and an empty address opens nothing', async () => {
    await openPage();
    await isAtRest();
    const frame = () => visit.page.evaluate(() => new Promise((resolve) => {
      window.incise.engine.addEventListener('frame', ({ detail }) => resolve({ color: detail.color, view: [...detail.camera.view] }), { once: true });
      window.incise.engine.send({ type: 'want', isWhole: true });
    }));
    const first = await frame();
    await press('f');
    for (const color of ['quality', 'scene']) {
      await visit.page.selectOption('#color', color);
      await visit.page.waitForTimeout(300);
      assert.equal((await frame()).color === first.color, color === 'scene', color);
    }
    const distance = ({ view }) => Math.hypot(...view.slice(12, 15));
    const zoomedBy = async (pixels) => {
      const before = distance(await frame());
      await visit.page.mouse.move(480, 320);
      await visit.page.mouse.wheel(0, pixels);
      await visit.page.waitForTimeout(300);
      return Math.log(before / distance(await frame()));
    };
    const little = await zoomedBy(-10), much = await zoomedBy(-100);
    assert.ok(little > 0 && Math.abs(much / little - 10) < 1, `${little}, ${much}`);
    await visit.page.evaluate(() => (location.hash = '#x'));
    await visit.page.evaluate(() => (location.hash = ''));
    await visit.page.waitForTimeout(300);
    assert.doesNotMatch(await hint(), /Opening/);
  });

  test('a pen that is put down while two fingers turn the view cuts nothing', async () => {
    await openPage({ hasTouch: true });
    const cut = await visit.page.evaluate(async () => {
      const place = document.getElementById('picture');
      place.setPointerCapture = () => {};
      const put = (type, pointerType, pointerId, clientX, clientY) => place.dispatchEvent(new PointerEvent(type, { pointerType, pointerId, clientX, clientY, button: 0, pressure: 1, bubbles: true }));
      put('pointerdown', 'touch', 2, 20, 150);
      put('pointerdown', 'touch', 3, 60, 150);
      put('pointerdown', 'pen', 4, 400, 290);
      for (let i = 0; i <= 20; ++i) {
        put('pointermove', 'pen', 4, 400 + 8 * i, 290 + i);
        await new Promise((resolve) => setTimeout(resolve, 16));
      }
      put('pointerup', 'pen', 4, 560, 310);
      for (const finger of [2, 3]) put('pointerup', 'touch', finger, 20, 150);
      await new Promise((resolve) => setTimeout(resolve, 500));
      return window.incise.figures.strokes;
    });
    assert.equal(cut, 0);
    await drag([0.4, 0.45], [0.6, 0.5]); // and the hand is free again
    await until(() => window.incise.figures.strokes === 1);
  });

  test('keys while the engine dies, and a stored theme of no sense, harm nothing', async () => {
    await openPage({ script: "localStorage.setItem('incise-theme', 'mauve')", colorScheme: 'dark' });
    assert.equal(await visit.page.getAttribute('html', 'data-theme'), 'dark');
    assert.equal(await visit.page.evaluate(() => window.incise.engine.ask('constructor').catch((error) => error.code)), 'BadArgument');
    await visit.page.evaluate(() => window.incise.engine.end());
    for (const key of ['t', 'r', 'Home', ']', '3']) await press(key);
    await visit.page.waitForTimeout(200);
    assert.deepEqual(visit.complaints, []);
    assert.equal(await visit.page.evaluate(() => window.incise.engine.ask('hash').catch((error) => error.code)), 'Ended');
  });

  test('figures, themes, picture and keys', async () => {
    await openPage({ colorScheme: 'light' });
    assert.equal(await visit.page.getAttribute('html', 'data-theme'), 'light');
    await press('t');
    assert.equal(await visit.page.getAttribute('html', 'data-theme'), 'dark');
    await isAtRest();
    await press('f');
    const hash = await ask('hash');
    await until((now) => document.getElementById('f-hash').textContent === now, hash);
    const empty = await visit.page.evaluate(() => [...document.querySelectorAll('#figures dd')].filter((each) => !each.textContent).map((each) => each.id));
    assert.deepEqual(empty, []);
    await press('h');
    assert.equal(await visit.page.locator('#figures').isVisible(), false);
    assert.equal(await visit.page.locator('#help').isVisible(), true);
    const [download] = await Promise.all([visit.page.waitForEvent('download'), visit.page.click('#shot')]);
    assert.equal(download.suggestedFilename(), 'incise.png');
    await press('7');
    assert.equal(await visit.page.getAttribute('[data-tool="Pin"]', 'aria-checked'), 'true');
    const unnamed = await visit.page.evaluate(() => [...document.querySelectorAll('button, select, input:not([hidden])')].filter((each) => !(each.textContent.trim() || each.labels?.length)).map((each) => each.id));
    assert.deepEqual(unnamed, []);
  });

  test('a body comes to rest, and nothing is computed or drawn then', async () => {
    await openPage();
    await isAtRest();
    await visit.page.waitForTimeout(400); // the last picture may be under way
    const counts = () => visit.page.evaluate(() => [window.incise.figures.frames, window.incise.frames]);
    const before = await counts();
    await visit.page.waitForTimeout(500);
    assert.deepEqual(await counts(), before);
  });

  test('the session goes on when the window is resized', async () => {
    await openPage();
    await visit.page.setViewportSize({ width: 500, height: 800 });
    await drag([0.4, 0.45], [0.6, 0.5]);
    await until(() => window.incise.figures.strokes === 1);
  });

  test('a fine skin is drawn over a coarse body and cut with it', async () => {
    await openPage({ path: '?body=kidney' });
    const drawn = () => visit.page.evaluate(() => window.incise.triangles);
    const whole = await figures(), skin = await drawn();
    assert.ok(skin > 10_000 && whole.tets < 3000, `${skin} triangles over ${whole.tets} tets`);
    await drag([0.47, 0.3], [0.5, 0.55], { steps: 30, pause: 16 });
    await until(() => window.incise.figures.strokes === 1 && window.incise.figures.cutTets > 0);
    await until((before) => window.incise.triangles > before + 20, skin);
    await isAtRest();
    await visit.page.screenshot({ path: `${pictures}/fine_cut.png` });
    await press('3');
    await drag([0.5, 0.1], [0.52, 0.9]);
    await until(async () => (await window.incise.engine.ask('quality')).pieces > 1);
    await visit.page.screenshot({ path: `${pictures}/fine_halves.png` });
    for (let i = 0; i < 2; ++i) await press('Control+z');
    await until((before) => window.incise.figures.strokes === 0 && window.incise.triangles === before, skin);
  });
});
