// SPDX-License-Identifier: Apache-2.0
// Cuts a cube of 750 tets in half, in the browser, and writes what came out into the page. The same file without a bundler
// (plain.html), with Vite (index.html) and with webpack (webpack.config.mjs).
import { load } from 'incise';

/** A MEDIT file of a cube of cells, each divided into the six tets of Kuhn's subdivision. */
function cube(cells) {
  const at = (x, y, z) => 1 + x + (cells + 1) * (y + (cells + 1) * z);
  const vertices = [], tets = [];
  for (let z = 0; z <= cells; ++z) for (let y = 0; y <= cells; ++y) for (let x = 0; x <= cells; ++x) vertices.push(`${x} ${y} ${z} 0`);
  for (let z = 0; z < cells; ++z) for (let y = 0; y < cells; ++y) for (let x = 0; x < cells; ++x) {
    for (const [i, j, k] of [[0, 1, 2], [1, 2, 0], [2, 0, 1], [0, 2, 1], [1, 0, 2], [2, 1, 0]]) {
      const corner = [x, y, z], path = [at(...corner)];
      for (const axis of [i, j, k]) { corner[axis] += 1; path.push(at(...corner)); }
      if ((j - i + 3) % 3 === 2) [path[2], path[3]] = [path[3], path[2]];
      tets.push(`${path.join(' ')} 0`);
    }
  }
  return `MeshVersionFormatted 2\nDimension 3\nVertices ${vertices.length}\n${vertices.join('\n')}\nTetrahedra ${tets.length}\n${tets.join('\n')}\nEnd\n`;
}

const { Engine } = await load();
const engine = Engine.open(cube(5), 'cube.mesh');
const { cutTets } = engine.cutPlane([1, 0.2, 0], 2.7);
document.querySelector('output').textContent = `${cutTets} tets were cut: ${engine.tetCount} tets in ${engine.pieces} pieces, hash ${engine.hash}`;
engine.dispose();
