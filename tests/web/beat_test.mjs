// SPDX-License-Identifier: Apache-2.0
// The beat of a worker's frames, on a clock of its own.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Beat } from '../../bindings/web/beat.mjs';

/** When frames begin that take `takes` ms each and are due every `period`. Timers are as browsers have them: 4 ms at least. */
function beginnings(takes, period) {
  const began = [];
  let now = 1000, next = now;
  const beat = new Beat(null, { hop: () => (next = now), timer: (ms) => (next = now + Math.max(4, ms)), clock: () => now });
  for (const ms of takes) {
    began.push((now = next) - 1000);
    now += ms;
    beat.wait(period);
  }
  return began;
}
const times = (count, value) => Array.from({ length: count }, () => value);

test('frames that take longer than they may follow each other without a pause', () => {
  const began = beginnings(times(50, 20), 16);
  assert.equal(began.at(-1) - began[1], 48 * 20);
});

test('frames that take almost as long as they may keep the beat', () => {
  const began = beginnings(times(100, 14), 16);
  assert.ok(Math.abs(began.at(-1) - began[10] - 89 * 16) <= 16, `${began.at(-1) - began[10]} ms`);
});

test('quick frames wait for the clock, and a late one is made up for', () => {
  const began = beginnings([3, 3, 3, 40, 3, 3, 3, 3, 3, 3, 3, 3], 16);
  const last = began.at(-1) - began[1];
  assert.ok(Math.abs(last - 10 * 16) <= 4, `${last} ms`);
});

test('what was lost in a long pause is not run after', () => {
  const began = beginnings([3, 3, 2000, ...times(30, 3)], 16);
  assert.ok(began.at(-1) > 2000 + 30 * 16 - 100);
});
