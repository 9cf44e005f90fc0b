// SPDX-License-Identifier: Apache-2.0
// What may be taken from the page while it works: the worker that computes, the one that draws, the picture's context; and what a
// browser may lack from the start.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { describe, test } from 'node:test';
import { differingShare } from './golden_picture.mjs';
import { Visit, pictures, skip } from './page_support.mjs';

describe('the page lives on', { skip }, () => {
  const visit = new Visit();
  const { ask, drag, figures, hint, isAtRest, isReady, openPage, press, until, workerOf } = visit;

  /** As a browser does that is short of memory: the worker says nothing any more. Returns when, in ms. */
  async function kill(name) {
    const began = Date.now();
    await workerOf(name).evaluate(() => void setTimeout(() => self.close()));
    return began;
  }
  const isReplaced = (times) => until((count) => window.incise.replacements === count && window.incise.state === 'ready', times);
  const isKept = async () => {
    await isAtRest();
    await until(async () => window.incise.engine.ask('isKept'));
  };

  test('a worker that is killed is noticed at once, and another one has all that was done', async (context) => {
    await openPage();
    await drag([0.36, 0.45], [0.52, 0.47]);
    await until(() => window.incise.figures.strokes === 1);
    await isKept();
    await drag([0.52, 0.47], [0.64, 0.5]);
    await until(() => window.incise.figures.strokes === 2);
    await isKept();
    const hash = await ask('hash'), { tets } = await figures();
    const killed = await kill('worker_thread');
    await until(() => window.incise.deathNoticed);
    const noticed = Math.round(await visit.page.evaluate(() => window.incise.deathNoticed) - killed);
    await isReplaced(1);
    context.diagnostic(`noticed after ${noticed} ms, back after ${Date.now() - killed} ms`);
    assert.ok(noticed < 1000, `${noticed} ms`);
    assert.match(await hint(), /All that was done is here/);
    assert.equal(await ask('hash'), hash);
    assert.equal((await figures()).tets, tets);
    await visit.page.screenshot({ path: `${pictures}/replaced.png` });
    for (const left of [1, 0]) {
      await press('Control+z');
      await until((count) => window.incise.figures.strokes === count, left);
    }
    assert.equal((await figures()).tets, 5040);
    await drag([0.4, 0.45], [0.6, 0.5]);
    await until(() => window.incise.figures.strokes === 1 && window.incise.figures.cutTets > 0);
  });

  test('a worker that is killed in the middle of a stroke leaves what came before it', async () => {
    await openPage();
    await drag([0.4, 0.45], [0.52, 0.47]);
    await until(() => window.incise.figures.strokes === 1);
    await isKept();
    const hash = await ask('hash');
    const { mouse } = visit.page, place = visit.place;
    await mouse.move(...place([0.4, 0.6]));
    await mouse.down();
    await mouse.move(...place([0.5, 0.62]), { steps: 10 });
    await kill('worker_thread');
    await mouse.move(...place([0.6, 0.62]), { steps: 10 });
    await mouse.up();
    await isReplaced(1);
    assert.equal(await ask('hash'), hash);
  });

  test('a mesh of one\'s own is there again, too', async () => {
    await openPage();
    await visit.page.setInputFiles('#file', 'models/cube.mesh');
    await until(() => window.incise.figures.tetsAtStart === 750);
    await press('3');
    await drag([0.5, 0.15], [0.52, 0.85]);
    await until(async () => (await window.incise.engine.ask('quality')).pieces === 2);
    await isKept();
    const hash = await ask('hash');
    await kill('worker_thread');
    await isReplaced(1);
    assert.equal(await ask('hash'), hash);
  });

  test('a worker that fails again and again is told of, with a way out', async () => {
    await openPage();
    await drag([0.4, 0.45], [0.6, 0.5]);
    await until(() => window.incise.figures.strokes === 1);
    await isKept();
    const recording = await visit.page.evaluate(async () => [...(await window.incise.engine.ask('recording'))]);
    for (let i = 1; i <= 3; ++i) {
      if (i > 1) await isReplaced(i - 1);
      if (i === 3) assert.match(await hint(), /as it was opened.*Save what was done/);
      if (i === 3) await visit.page.context().setOffline(true);
      await workerOf('worker_thread').evaluate(() => void setTimeout(() => { throw new Error('memory is out'); }));
      await until((times) => times === 3 || window.incise.replacements === times, i);
    }
    await visit.page.locator('#cover').getByText(/memory is out/).waitFor();
    visit.complaints = visit.complaints.filter((text) => !/memory is out/.test(text));
    await visit.page.screenshot({ path: `${pictures}/cover.png` });
    assert.match(await visit.page.locator('#cover').textContent(), /no connection/);
    const [download] = await Promise.all([visit.page.waitForEvent('download'), visit.page.click('#cover button >> text=Save what was done')]);
    assert.equal(download.suggestedFilename(), 'incise-recording.jsonl');
    assert.deepEqual([...readFileSync(await download.path())], recording);
    await visit.page.context().setOffline(false);
    await visit.page.click('#cover button >> text=Start again');
    await isReady();
    assert.equal((await figures()).tets, 5040);
  });

  const isDrawnAgain = async (before) => {
    await until((drawn) => window.incise.frames > drawn, await visit.page.evaluate(() => window.incise.frames)).catch(() => {});
    await visit.page.waitForTimeout(300);
    const share = differingShare(before, await visit.page.screenshot({ style: '#hint { visibility: hidden }' }));
    assert.ok(share < 0.005, `${share} of the picture is another one`);
  };

  test('a worker that draws is replaced as well', async () => {
    await openPage({ path: '?look=full' });
    await isAtRest();
    const before = await visit.page.screenshot({ style: '#hint { visibility: hidden }' });
    await kill('drawing_thread');
    await until(() => window.incise.drawingReplaced === 1);
    await isDrawnAgain(before);
    await drag([0.4, 0.45], [0.6, 0.5]);
    await until(() => window.incise.figures.strokes === 1);
  });

  test('a picture whose context is lost comes back', async () => {
    await openPage({ path: '?look=full' });
    await isAtRest();
    const before = await visit.page.screenshot({ style: '#hint { visibility: hidden }' });
    await workerOf('drawing_thread').evaluate(() => {
      globalThis.lost = globalThis.drawer.picture.renderer.getContext().getExtension('WEBGL_lose_context');
      globalThis.lost.loseContext();
    });
    await until(() => /lost/.test(document.getElementById('hint').textContent));
    await visit.page.click('#shot');
    await until(() => /no picture now/.test(document.getElementById('hint').textContent));
    await workerOf('drawing_thread').evaluate(() => globalThis.lost.restoreContext());
    await until(() => /back/.test(document.getElementById('hint').textContent));
    await isDrawnAgain(before);
    await drag([0.4, 0.45], [0.6, 0.5]);
    await until(() => window.incise.figures.strokes === 1);
    visit.complaints = visit.complaints.filter((text) => !/Context (Lost|Restored)|CONTEXT_LOST/i.test(text));
  });

  test('an engine that the server does not send is no engine that stopped', async () => {
    await openPage();
    await visit.page.route('**/*.wasm', (route) => route.fulfill({ status: 503 }));
    await visit.page.reload();
    await visit.page.locator('#cover').getByText(/could not be fetched/).waitFor();
    assert.match(await visit.page.locator('#cover').textContent(), /server did not send it: .*\.wasm: the server answers 503\./);
    visit.complaints = visit.complaints.filter((text) => !/503/.test(text));
    await visit.page.unroute('**/*.wasm');
    await visit.page.click('#cover button >> text=Start again');
    await isReady();
  });

  test('without WebAssembly there is a message and no blank page', async () => {
    await openPage({ waits: false, script: 'delete globalThis.WebAssembly' });
    assert.match(await visit.page.locator('#cover').textContent(), /no WebAssembly/);
  });

  test('a browser that cannot hand its canvas over draws in the page itself', async () => {
    await openPage({ script: 'delete HTMLCanvasElement.prototype.transferControlToOffscreen' });
    assert.equal(workerOf('drawing_thread'), undefined);
    await drag([0.4, 0.45], [0.6, 0.5]);
    await until(() => window.incise.figures.strokes === 1);
    await visit.page.screenshot({ path: `${pictures}/drawn_here.png` });
  });
});

describe('a browser without WebGL', { skip }, () => {
  const visit = new Visit('--disable-gpu', '--disable-software-rasterizer');

  test('is told so, and no page is blank', async () => {
    await visit.openPage({ waits: false });
    await visit.page.locator('#cover').getByText(/WebGL 2/).waitFor();
    assert.deepEqual(visit.complaints, []);
  });
});
