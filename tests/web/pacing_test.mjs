// SPDX-License-Identifier: Apache-2.0
// The rules by which the page asks its workers, without any of them.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Frames, batches, inTurn, newest } from '../../web/src/pacing.mjs';

/** Promises that are kept when told to. */
function gates() {
  const open = [];
  return { wait: () => new Promise((resolve) => open.push(resolve)), next: () => open.shift()?.(), get count() { return open.length; } };
}
const soon = () => new Promise((resolve) => setTimeout(resolve));

test('of values that come while one is under way the newest alone is sent', async () => {
  const gate = gates(), sent = [];
  const send = newest((value) => (sent.push(value), gate.wait()));
  for (const value of [1, 2, 3, 4]) send(value);
  assert.deepEqual(sent, [1]);
  gate.next();
  await soon();
  assert.deepEqual(sent, [1, 4]);
  gate.next();
  await soon();
  assert.equal(gate.count, 0);
  send(5);
  assert.deepEqual(sent, [1, 4, 5]);
});

test('events go in batches, one at a time and none lost', async () => {
  const gate = gates(), sent = [], waiting = [];
  const poke = batches(() => waiting.splice(0), (batch) => (sent.push(batch), gate.wait()), (go) => setTimeout(go));
  for (const event of [1, 2, 3]) poke(waiting.push(event));
  await soon();
  for (const event of [4, 5]) poke(waiting.push(event));
  await soon();
  assert.deepEqual(sent, [[1, 2, 3]]);
  gate.next();
  await soon();
  await soon();
  assert.deepEqual(sent, [[1, 2, 3], [4, 5]]);
});

test('acts wait for their turn, a key that is held down does not, and one that fails blocks no other', async () => {
  const gate = gates(), done = [];
  const turn = inTurn();
  const first = turn(() => (done.push('a'), gate.wait()));
  const second = turn(() => Promise.reject(new Error('no')));
  assert.equal(turn(() => done.push('repeated'), true), null);
  const third = turn(() => done.push('c'));
  await soon();
  assert.deepEqual(done, ['a']);
  gate.next();
  await first;
  await assert.rejects(second, /no/);
  await third;
  assert.deepEqual(done, ['a', 'c']);
});

test('of frames one is drawn and one waits; the next is wanted when that goes on', () => {
  const shown = [];
  let wanted = 0;
  const drawing = { isBusy: false, show: (frame) => (shown.push(frame), (drawing.isBusy = true)) };
  const frames = new Frames(drawing, () => ++wanted);
  frames.take('a');
  assert.deepEqual([shown, wanted], [['a'], 1]);
  frames.take('b');
  assert.deepEqual([shown, wanted], [['a'], 1]);
  drawing.isBusy = false;
  frames.pass();
  assert.deepEqual([shown, wanted], [['a', 'b'], 2]);
  frames.pass();
  assert.equal(wanted, 2);
});

test('where one processor computes and draws, the next frame is wanted a while after a picture is done', () => {
  const shown = [], rests = [];
  let wanted = 0;
  const drawing = { isBusy: false, show: (frame) => (shown.push(frame), (drawing.isBusy = true)) };
  const frames = new Frames(drawing, () => ++wanted, (then, ms) => rests.push([then, ms]));
  frames.restMs = 20;
  frames.take('a');
  assert.deepEqual([shown, rests], [['a'], []]);
  drawing.isBusy = false;
  frames.pass();
  assert.deepEqual([wanted, rests.length, rests[0][1]], [0, 1, 20]);
  rests[0][0]();
  frames.take('b');
  assert.deepEqual([shown, wanted, rests.length], [['a', 'b'], 1, 1]);
});
