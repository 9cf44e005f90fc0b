// SPDX-License-Identifier: Apache-2.0
// What is opened of files that were chosen together, and what a link may unpack to.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { gather } from '../../web/src/files.mjs';
import { fromFragment, toFragment } from '../../web/src/link.mjs';

const file = (name, text = 'x') => new File([text], name);
const scene = (...names) => file('scene.json', JSON.stringify({ bodies: names.map((each) => ({ file: each })) }));
const bytes = Uint8Array.of(1);

async function gathered(chosen, isOpen = {}, page = []) {
  const { what, missing, leftOut } = await gather(chosen, isOpen, page, async () => bytes);
  return { name: what.name, files: Object.keys(what.files).sort(), missing, leftOut };
}

test('what lies in folders is taken by the last part of its name', async () => {
  const names = ['../models/a.mesh', '/home/me/b.mesh', 'C:\\data\\c.mesh'];
  const all = await gathered([...names.map((each) => file(each.split(/[\\/]/).pop())), scene(...names)]);
  assert.deepEqual(all, { name: 'scene.json', files: ['a.mesh', 'b.mesh', 'c.mesh'], missing: [], leftOut: [] });
  assert.deepEqual((await gathered([scene('../models/meat.mesh')], {}, ['meat.mesh'])).files, ['meat.mesh']);
  assert.deepEqual((await gathered([scene('../models/a.mesh')])).missing, ['a.mesh']);
});

test('names meet that differ by case or by how accents are written, under the name that is asked for', async () => {
  const { files, missing } = await gathered([file('LIVER.Mesh'), file('a\u0308.mesh'), scene('liver.mesh', '\u00e4.mesh')]);
  assert.deepEqual([files, missing], [['liver.mesh', '\u00e4.mesh'], []]);
});

test('a pair of TetGen brings its other half along', async () => {
  assert.deepEqual(await gathered([file('q.NODE'), file('q.ELE')]), { name: 'q.NODE', files: ['q.ele'], missing: [], leftOut: [] });
  const recording = file('r.jsonl', '{"file": "q.node"}\n{}');
  assert.deepEqual((await gathered([recording], { 'q.node': bytes, 'q.ele': bytes })).files, ['q.ele', 'q.node']);
  assert.deepEqual((await gathered([file('q.node')], { 'q.ele': bytes })).missing, ['q.ele']); // of another pair
});

test('what nothing names is left out and said, and no file takes the place of another', async () => {
  assert.deepEqual((await gathered([file('a.mesh'), file('b.mesh')])).leftOut, ['b.mesh']);
  await assert.rejects(gathered([file('a.mesh', '1'), file('a.mesh', '2')]), /two files are called a\.mesh/);
  const recording = file('r.jsonl', '{"file": "letter.txt"}\n{}'); // which may hold a mesh
  assert.deepEqual(await gathered([recording, file('letter.txt')]), { name: 'r.jsonl', files: ['letter.txt'], missing: [], leftOut: [] });
});

test('a link is what was packed, and does not unpack without end', async () => {
  const recording = new TextEncoder().encode('{"a": 1}\n'.repeat(1000));
  assert.deepEqual(await fromFragment(await toFragment('skin', recording)), { body: 'skin', recording });
  await assert.rejects(fromFragment(await toFragment('skin', new Uint8Array(65e6))), /too large/);
});
