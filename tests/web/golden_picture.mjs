// SPDX-License-Identifier: Apache-2.0
// Pictures against golden ones of tests/web/golden. Both are shrunk by whole factors first: machines differ in how they smooth edges
// and set type, and small files are kept. INCISE_UPDATE_GOLDENS=1 writes them anew: look at them before they are committed.
import { existsSync, mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { at } from './support.mjs';

const require = createRequire(at('web/package.json'));
const { PNG } = require('pngjs');
const { default: pixelmatch } = await import(require.resolve('pixelmatch'));

const folder = at('tests/web/golden'), differing = at('build/web-pictures');
const WIDTH = 480; // about that of what is compared
const COLOR = 0.12; // of two pixels that count as different, 0 to 1

/** The mean of each square of `factor` pixels. */
function shrunk({ width, height, data }) {
  const factor = Math.max(1, Math.round(width / WIDTH));
  const small = new PNG({ width: Math.floor(width / factor), height: Math.floor(height / factor) });
  const mean = (left, top, channel) => {
    let sum = 0;
    for (let y = 0; y < factor; ++y) for (let x = 0; x < factor; ++x) sum += data[4 * ((top + y) * width + left + x) + channel];
    return Math.round(sum / factor ** 2);
  };
  for (let y = 0; y < small.height; ++y) {
    for (let x = 0; x < small.width; ++x) {
      for (let channel = 0; channel < 4; ++channel) small.data[4 * (y * small.width + x) + channel] = mean(x * factor, y * factor, channel);
    }
  }
  return small;
}

/** The share of pixels in which two PNGs differ; what differs is written to the folder of pictures where a name is given. */
export function differingShare(one, other, name) {
  const [a, b] = [one, other].map((each) => shrunk(PNG.sync.read(each)));
  return compared(a, b, name);
}

function compared(a, b, name) {
  if (a.width !== b.width || a.height !== b.height) return 1;
  const difference = new PNG({ width: a.width, height: a.height });
  const count = pixelmatch(a.data, b.data, difference.data, a.width, a.height, { threshold: COLOR });
  if (name && count > 0) {
    mkdirSync(differing, { recursive: true });
    writeFileSync(`${differing}/${name}.differs.png`, PNG.sync.write(difference));
  }
  return count / (a.width * a.height);
}

/** The share in which a PNG differs from its golden picture; 1 where there is none. */
export function shareOffGolden(picture, name) {
  const file = `${folder}/${name}.png`, small = shrunk(PNG.sync.read(picture));
  if (process.env.INCISE_UPDATE_GOLDENS) {
    mkdirSync(folder, { recursive: true });
    writeFileSync(file, PNG.sync.write(small));
  }
  return existsSync(file) ? compared(small, PNG.sync.read(readFileSync(file)), name) : 1;
}
