// SPDX-License-Identifier: Apache-2.0
// usage: node cut_a_file.mjs MESH OUT      cuts it in half across x, and writes what comes out
import { readFileSync, writeFileSync } from 'node:fs';
import { extname } from 'node:path';
import { load } from 'incise';

const [, , mesh, out] = process.argv;
if (!out) console.error('usage: node cut_a_file.mjs MESH OUT'), process.exit(2);
const engine = (await load()).Engine.open(readFileSync(mesh), mesh);
const x = engine.points().filter((_, i) => i % 3 === 0);
engine.cutPlane([1, 0, 0], (Math.min(...x) + Math.max(...x)) / 2);
writeFileSync(out, engine.write(extname(out)));
console.log(`${engine.tetCount} tets in ${engine.pieces} pieces, hash ${engine.hash}`);
