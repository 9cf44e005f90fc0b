// SPDX-License-Identifier: Apache-2.0
// The npm package as its users have it: installed from the file that `script/web package` makes.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, readdirSync, rmSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, test } from 'node:test';
import { at, hasPlain, incise } from './support.mjs';

const folder = mkdtempSync(join(tmpdir(), 'incise package '));
after(() => rmSync(folder, { recursive: true }));
const run = (command, ...args) => execFileSync(command, args, { cwd: folder, encoding: 'utf8', stdio: ['ignore', 'pipe', 'pipe'] });

const packed = at('build', readdirSync(at('build')).find((name) => /^incise-[\d.]+\.tgz$/.test(name)));
writeFileSync(join(folder, 'package.json'), '{"name": "user", "private": true, "type": "module"}');
run('npm', 'install', '--offline', '--no-audit', '--no-fund', packed);

test('the example cuts a file in node as the native command does', async () => {
  const example = join(folder, 'node_modules/incise/examples/cut_a_file.mjs');
  const lines = readFileSync(example, 'utf8').split('\n').filter((line) => line && !line.startsWith('//'));
  assert.ok(lines.length <= 10, `the example has ${lines.length} lines`);
  const said = run('node', example, at('models/cube.mesh'), 'halves.msh');
  const report = JSON.parse(await incise('cut', at('models/cube.mesh'), '--plane', '1,0,0,0.5', '--report', '-'));
  assert.match(said, new RegExp(`^${report.mesh.after.tets} tets in 2 pieces, hash ${report.hash}`));
  const info = JSON.parse(await incise('info', join(folder, 'halves.msh'), '--json'));
  assert.equal(info.components, 2);
});

test('types hold for a program that uses the package, and refuse one that does not', () => {
  const tsc = createRequire(at('web/package.json')).resolve('typescript/bin/tsc');
  const check = (text) => {
    writeFileSync(join(folder, 'user.mts'), text);
    return run('node', tsc, '--noEmit', '--strict', '--target', 'es2022', '--module', 'nodenext', '--lib', 'es2022,dom,esnext.disposable', 'user.mts');
  };
  check("import { load } from 'incise';\nconst { Engine } = await load();\nconst n: number = Engine.open('', 'x').cutPlane([1, 0, 0], 1).cutTets;\nconsole.log(n);\n");
  assert.throws(() => check("import { load } from 'incise';\n(await load()).Engine.open('', 'x').cutPlane('x', 1);\n"), /.*/);
});

test('a bundler takes the module and its .wasm along', { skip: hasPlain ? false : 'the module without SIMD was left out' }, () => {
  const vite = createRequire(at('web/package.json')).resolve('vite/package.json').replace('package.json', 'bin/vite.js');
  writeFileSync(join(folder, 'index.html'), '<script type="module">import { load } from "incise"; load().then((m) => console.log(m.version));</script>');
  run('node', vite, 'build');
  const files = readdirSync(join(folder, 'dist/assets'));
  assert.ok(files.some((name) => /^incise_core.*\.wasm$/.test(name)), files.join(' '));
  assert.ok(files.some((name) => /^incise_plain.*\.wasm$/.test(name)), files.join(' '));
});
