// SPDX-License-Identifier: Apache-2.0
// Numbers as the page shows them.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { grouped } from '../../web/src/numbers.mjs';

test('thousands stand apart', () => {
  for (const number of [0, 7, 999, 1000, 5040, 10668, 123456, 1234567]) assert.equal(grouped(number), number.toLocaleString('en'));
});
