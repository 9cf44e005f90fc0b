// SPDX-License-Identifier: Apache-2.0
// How much the page draws, without drawing any of it.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Detail } from '../../web/src/detail.mjs';

test('a graphics processor begins with all, and falls by one level where most pictures are slow', () => {
  const detail = new Detail(undefined, false);
  assert.deepEqual([detail.level, detail.still], ['full', 'full']);
  for (let i = 0; i < 9; ++i) assert.equal(detail.judge(40), false);
  assert.equal(detail.judge(40), true);
  assert.deepEqual([detail.level, detail.still], ['plain', 'full']);
  for (let i = 0; i < 100; ++i) assert.equal(detail.judge(i % 2 ? 40 : 5), false);
});

test('a processor that draws begins with few pixels, and has more for what stands still', () => {
  const detail = new Detail(undefined, true);
  assert.deepEqual([detail.level, detail.still], ['coarse', 'plain']);
  for (let i = 0; i < 40; ++i) assert.equal(detail.judge(100), false);
});

test('a level that is asked for stays', () => {
  for (const isSoftware of [false, true]) {
    const detail = new Detail('plain', isSoftware);
    for (let i = 0; i < 40; ++i) assert.equal(detail.judge(100), false);
    assert.deepEqual([detail.level, detail.still], ['plain', 'plain']);
  }
});
