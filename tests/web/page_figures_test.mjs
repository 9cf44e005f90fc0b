// SPDX-License-Identifier: Apache-2.0
// Figures that the page measures of itself, printed and written to build/web-pictures/figures.json. What it must reach is asked for in
// full with INCISE_WEB_ALL=1, on a machine that does nothing else; without it times are printed alone, so that a busy one does not fail.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { writeFileSync } from 'node:fs';
import { gzipSync } from 'node:zlib';
import { after, describe, test } from 'node:test';
import { Visit, pictures, skip } from './page_support.mjs';
import { read } from './support.mjs';

const asksTimes = Boolean(process.env.INCISE_WEB_ALL);
const MUST = { cuttableMs: 4000, framesAt5000: 60, framesAt10668: 30, blockMs: 50, gzippedBytes: 1.5e6 };
const ROUNDS = process.env.INCISE_WEB_ALL ? 200 : 20;
const found = {};

function askTime(holds, message) {
  if (asksTimes) assert.ok(holds, message);
}

describe('figures of the page', { skip }, () => {
  const visit = new Visit();
  const { ask, drag, openPage, press, until } = visit;
  after(() => writeFileSync(`${pictures}/figures.json`, JSON.stringify(found, null, 1)));

  function note(context, name, figures) {
    found[name] = figures;
    context.diagnostic(`${name}: ${JSON.stringify(figures)}`);
  }

  /** What an expression is in the page, by the protocol alone: 300 kB of Playwright's own script would be read by what is measured. */
  async function told(expression) {
    const protocol = await visit.page.context().newCDPSession(visit.page);
    const { result } = await protocol.send('Runtime.evaluate', { expression: `JSON.stringify(${expression})`, returnByValue: true });
    await protocol.detach();
    return result.value === undefined ? undefined : JSON.parse(result.value);
  }
  /** Bytes of the page's own heap, without garbage: `performance.memory` is rounded, and old. */
  async function heapOfPage() {
    const protocol = await visit.page.context().newCDPSession(visit.page);
    await protocol.send('HeapProfiler.collectGarbage');
    const { usedSize } = await protocol.send('Runtime.getHeapUsage');
    await protocol.detach();
    return usedSize;
  }
  const now = () => told('{ ...window.incise, engine: undefined, at: performance.now() }');
  async function isReady() {
    for (let i = 0; (await told('window.incise?.state')) !== 'ready'; ++i) {
      assert.ok(i < 1200, 'the page is not ready');
      await new Promise((resolve) => setTimeout(resolve, 50));
    }
  }

  /** A stroke that takes so long, as a hand's does, however slowly the page answers. */
  async function strokeFor(ms, [from, to]) {
    const { mouse } = visit.page, began = Date.now();
    await mouse.move(...visit.place(from));
    await mouse.down();
    for (let share = 0; share < 1;) {
      share = Math.min(1, (Date.now() - began) / ms);
      await mouse.move(...visit.place([0, 1].map((i) => from[i] + (to[i] - from[i]) * share)));
      await new Promise((resolve) => setTimeout(resolve, 12));
    }
    await mouse.up();
  }

  /** A stroke of three seconds: what was simulated and drawn in it. */
  async function strokeOf(body) {
    visit.fetched.clear();
    await openPage({ path: `?body=${body}`, waits: false });
    await isReady();
    await visit.page.waitForTimeout(500);
    const before = await now();
    await strokeFor(3000, [[0.4, 0.5], [0.62, 0.55]]);
    const after = await now(), seconds = (after.at - before.at) / 1000;
    return {
      tets: after.figures.tetsAtStart, cutTets: after.figures.cutTets, cuttableMs: Math.round(after.cuttableMs),
      simulatedPerSecond: Math.round((after.figures.frames - before.figures.frames) / seconds),
      drawnPerSecond: Math.round((after.frames - before.frames) / seconds), level: after.level, renderer: after.renderer,
      longestBlockMs: after.longestBlockMs, longestBlockLoadingMs: after.longestBlockLoadingMs, mostWaiting: after.mostWaiting,
      gzippedBytes: [...visit.fetched].reduce((sum, path) => sum + gzipSync(read('build/site', path)).length, 0),
    };
  }

  for (const [body, least] of [['patch', MUST.framesAt5000], ['bunny', MUST.framesAt10668], ['kidney', 0]]) {
    test(`size, frames and blocks with the blade in the ${body}`, async (context) => {
      const figures = await strokeOf(body);
      note(context, body, figures);
      assert.ok(figures.cutTets > 0);
      assert.ok(visit.fetched.size >= 6 && figures.gzippedBytes <= MUST.gzippedBytes, `${figures.gzippedBytes} bytes`);
      askTime(figures.simulatedPerSecond >= 0.95 * least, `${figures.simulatedPerSecond} frames a second`); // a timer's whole ms
      askTime(Math.max(figures.longestBlockMs, figures.longestBlockLoadingMs) <= MUST.blockMs, 'the page was blocked');
      assert.ok(figures.mostWaiting <= 4, `${figures.mostWaiting} questions waited`);
    });
  }

  /** All of the browser on one core, as on a small machine. */
  function pin(core) {
    const all = execFileSync('ps', ['-eo', 'pid,ppid'], { encoding: 'utf8' }).trim().split('\n').slice(1).map((line) => line.trim().split(/\s+/).map(Number));
    const pids = [process.pid];
    for (const pid of pids) pids.push(...all.filter(([, parent]) => parent === pid).map(([child]) => child));
    for (const pid of pids.slice(1)) {
      try {
        execFileSync('taskset', ['-acp', String(core), String(pid)], { stdio: 'ignore' });
      } catch { /* it has ended */ }
    }
  }

  test('time from navigation to cuttable, cold, the browser on one core', async (context) => {
    await openPage({ path: 'bodies/web_patch.json', waits: false }); // processes are there, nothing of the page is
    pin(0);
    const cold = await visit.page.context().newPage();
    await visit.page.close();
    visit.page = cold;
    pin(0);
    const { origin } = new URL(visit.url);
    await cold.goto(`${origin}/`);
    await isReady();
    const { cuttableMs, loadedMs, longestBlockLoadingMs } = await now();
    note(context, 'oneCore', { cuttableMs: Math.round(cuttableMs), loadedMs: Math.round(loadedMs), longestBlockLoadingMs });
    askTime(cuttableMs <= MUST.cuttableMs, `${cuttableMs} ms`);
    pin('0-63');
    visit.complaints = visit.complaints.filter((text) => !/404/.test(text)); // a file that is shown asks for an icon
  });

  test('questions never queue up, however fast hands are', async (context) => {
    await openPage();
    const { mouse } = visit.page, place = visit.place;
    await mouse.move(...place([0.4, 0.45]));
    await mouse.down();
    for (let i = 0; i < 400; ++i) await mouse.move(...place([0.5 + 0.12 * Math.sin(i / 30), 0.47 + 0.03 * Math.cos(i / 17)]));
    await mouse.up();
    for (let i = 0; i < 60; ++i) await press(']');
    for (let i = 0; i < 20; ++i) await press('Control+z');
    const { mostWaiting } = await now();
    note(context, 'mostWaiting', mostWaiting);
    assert.ok(mostWaiting <= 4, `${mostWaiting} questions waited`);
    await until(() => window.incise.engine.waiting === 0);
  });

  test('memory does not grow over strokes that are taken back', async (context) => {
    await openPage();
    const round = async () => {
      await drag([0.42, 0.45], [0.56, 0.48], { steps: 5, pause: 16 });
      await until(() => window.incise.figures.strokes === 1);
      await press('Control+z');
      await until(() => window.incise.figures.strokes === 0);
    };
    const bytes = async () => {
      const page = await heapOfPage();
      const { used, taken } = await ask('memory'), recording = await visit.page.evaluate(async () => (await window.incise.engine.ask('recording')).length);
      return { page, used, taken, recording };
    };
    for (let i = 0; i < 5; ++i) await round();
    const early = await bytes();
    for (let i = 5; i < ROUNDS; ++i) await round();
    const late = await bytes();
    note(context, 'memory', { rounds: ROUNDS, early, late });
    assert.ok(late.page < early.page + 2e6, 'the page grew');
    assert.ok(late.used - early.used < 2 * (late.recording - early.recording) + 2e6, 'the engine grew by more than what it records');
  });
});
