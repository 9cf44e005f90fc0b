// SPDX-License-Identifier: Apache-2.0
// npx webpack: webpack 5, from 5.75 on, takes the module and its .wasm along without a loader. Needs webpack and webpack-cli.
import { readFileSync, writeFileSync, mkdirSync } from 'node:fs';

mkdirSync('dist-webpack', { recursive: true });
writeFileSync('dist-webpack/index.html', readFileSync('index.html', 'utf8').replace('./cut.mjs', './main.mjs'));

export default {
  mode: 'production',
  entry: './cut.mjs',
  experiments: { outputModule: true, topLevelAwait: true },
  output: { path: `${process.cwd()}/dist-webpack`, filename: 'main.mjs', module: true },
};
