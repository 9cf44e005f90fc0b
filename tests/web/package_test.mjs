// SPDX-License-Identifier: Apache-2.0
// The npm package as its users have it: installed from the file that `script/web package` makes.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { cpSync, mkdtempSync, readFileSync, readdirSync, rmSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, describe, test } from 'node:test';
import { at, executablePath, hasPlain, incise, launch, serve } from './support.mjs';

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
  assert.throws(() => run('node', example), (error) => error.status === 2 && /^usage: node cut_a_file\.mjs MESH OUT\n$/.test(error.stderr));
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
  // Neither library need be named by who uses the package.
  for (const text of ["import { load } from 'incise';\n(await load()).Engine.open('', 'x').dispose();\n",
    "import { SessionWorker } from 'incise/worker';\nawait new SessionWorker().ask('color', { name: 'scene' });\n"]) {
    writeFileSync(join(folder, 'plain.mts'), text);
    run('node', tsc, '--noEmit', '--strict', '--target', 'es2022', '--module', 'nodenext', '--lib', 'es2022', 'plain.mts');
  }
  assert.throws(() => check("import { load } from 'incise';\n(await load()).Engine.open('', 'x').cutPlane('x', 1);\n"), /.*/);
});

const browser = executablePath ? null : 'Chromium is not installed: script/bootstrap --web';

/** What a page of the examples writes, served from a folder. */
async function written(site, page) {
  const server = await serve(site);
  const chromium = await launch();
  try {
    const tab = await chromium.newPage();
    const complaints = [];
    tab.on('pageerror', (error) => complaints.push(String(error)));
    tab.on('console', (message) => message.type() === 'error' && complaints.push(message.text()));
    await tab.goto(server.url + page);
    await tab.waitForFunction(() => /hash/.test(document.querySelector('output')?.textContent ?? ''), null, { timeout: 60_000 }).catch(() => {});
    assert.deepEqual(complaints, []);
    return await tab.locator('output').textContent();
  } finally {
    await chromium.close();
    server.close();
  }
}

describe('the example of a page', { skip: browser ?? false }, () => {
  const tool = (name, file) => createRequire(at('web/package.json')).resolve(`${name}/package.json`).replace('package.json', file);
  const modules = hasPlain ? ['core', 'plain'] : ['core']; // a copy of a file is bundled once
  before(() => {
    const installed = join(folder, 'node_modules/incise');
    cpSync(join(installed, 'examples/browser'), folder, { recursive: true });
    // Bundlers look for the module without SIMD. Where it was left out the other stands for it; nothing loads it here.
    if (!hasPlain) for (const type of ['mjs', 'wasm']) cpSync(join(installed, `incise_core.${type}`), join(installed, `incise_plain.${type}`));
  });
  const isRight = (text) => assert.match(text, /^\d+ tets were cut: \d+ tets in 2 pieces, hash [0-9a-f]{16}$/);

  test('runs without a bundler', async () => isRight(await written(folder, 'plain.html')));

  test('is built by Vite, with both modules', async () => {
    run('node', tool('vite', 'bin/vite.js'), 'build');
    const files = readdirSync(join(folder, 'dist-vite/assets'));
    for (const name of modules) assert.ok(files.some((file) => file.startsWith(`incise_${name}`) && file.endsWith('.wasm')), files.join(' '));
    isRight(await written(join(folder, 'dist-vite'), ''));
  });

  test('is built by webpack, with both modules', async () => {
    run('node', tool('webpack', 'bin/webpack.js'));
    assert.equal(readdirSync(join(folder, 'dist-webpack')).filter((file) => file.endsWith('.wasm')).length, modules.length);
    isRight(await written(join(folder, 'dist-webpack'), ''));
  });
});
