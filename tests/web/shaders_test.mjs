// SPDX-License-Identifier: Apache-2.0
// The page finds what it replaces in the window's shaders. Needs neither the page nor the module: the texts are read from the sources.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';
import { ballShader, lineShader, rimShader, solidShader, surfaceShader, triangleShader } from '../../web/src/glsl.mjs';

const texts = {};
for (const header of ['marks', 'shadow', 'solid', 'surface']) {
  const source = readFileSync(new URL(`../../src/render/${header}_shaders.h`, import.meta.url), 'utf8');
  for (const [, name, text] of source.matchAll(/ (k\w+) = R"\(([^]*?)\)";/g)) texts[name] = text;
}
const shader = (vertex, fragment, before = '') => ({ vertex: before + texts[vertex], fragment: before + texts[fragment] });

test('the page finds what it replaces in the shaders', () => {
  for (const isPlain of [false, true]) assert.ok(surfaceShader(shader('kSurfaceVertex', 'kSurfaceFragment'), isPlain).fragmentShader);
  const marks = texts.kMarksPrelude;
  const all = [
    lineShader(shader('kLineVertex', 'kLineFragment', marks)),
    rimShader(shader('kRimVertex', 'kRimFragment', marks)),
    ballShader(shader('kBallVertex', 'kBallFragment', marks)),
    triangleShader(shader('kFillVertex', 'kFillFragment', marks)),
    solidShader(shader('kSolidVertex', 'kSolidFragment')),
  ];
  for (const { vertexShader, fragmentShader } of all) assert.doesNotMatch(vertexShader + fragmentShader, /undefined|usamplerBuffer|noperspective/);
});

test('a shader that differs is not guessed at', () => {
  assert.throws(() => surfaceShader({ vertex: 'void main() {', fragment: '' }, false), /has no "uniform usamplerBuffer looks;" any more/);
});
