// SPDX-License-Identifier: Apache-2.0
// What the tests of the module and of the page share.
import { execFile } from 'node:child_process';
import { existsSync, readFileSync } from 'node:fs';
import { createServer } from 'node:http';
import { createRequire } from 'node:module';
import { dirname, extname, join, normalize } from 'node:path';
import { fileURLToPath } from 'node:url';
import { promisify } from 'node:util';

export const root = join(dirname(fileURLToPath(import.meta.url)), '..', '..');
export const at = (...parts) => join(root, ...parts);
export const read = (...parts) => readFileSync(at(...parts));
/** `INCISE_WEB_PLAIN=0 script/web` leaves the module without SIMD out. */
export const hasPlain = existsSync(at('build/npm/incise_plain.wasm'));

/** Runs the native command. Rejects unless it exits with 0. */
export async function incise(...args) {
  return (await promisify(execFile)(at('build/release/bin/incise'), args, { maxBuffer: 1e8 })).stdout;
}

const TYPES = { '.html': 'text/html', '.js': 'text/javascript', '.mjs': 'text/javascript', '.css': 'text/css', '.wasm': 'application/wasm', '.json': 'application/json', '.svg': 'image/svg+xml', '.png': 'image/png' };

/** Serves a folder; `url` is its address. */
export async function serve(folder) {
  const server = createServer((request, answer) => {
    const path = decodeURIComponent(new URL(request.url, 'http://host').pathname);
    const file = join(folder, normalize(path.endsWith('/') ? `${path}index.html` : path));
    if (!existsSync(file)) return answer.writeHead(404).end();
    answer.writeHead(200, { 'Content-Type': TYPES[extname(file)] ?? 'application/octet-stream' }).end(readFileSync(file));
  });
  await new Promise((resolve) => server.listen(0, '127.0.0.1', resolve));
  return { url: `http://127.0.0.1:${server.address().port}/`, close: () => server.close() };
}

export const executablePath = ['/usr/bin/chromium', '/usr/bin/google-chrome'].find(existsSync);

/** Starts Chromium. It draws by the processor, so that machines without a graphics processor can run this. */
export function launch(...flags) {
  const { chromium } = createRequire(at('web/package.json'))('playwright-core');
  return chromium.launch({ executablePath, args: ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--js-flags=--expose-gc', ...flags] });
}
