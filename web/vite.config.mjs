// SPDX-License-Identifier: Apache-2.0
import { existsSync } from 'node:fs';
import { fileURLToPath } from 'node:url';

const here = (path) => fileURLToPath(new URL(path, import.meta.url));
// `INCISE_WEB_PLAIN=0 script/web` leaves it out: browsers without SIMD cannot run that page.
const missing = existsSync(here('../build/npm/incise_plain.mjs')) ? [] : [/incise_plain/];

export default {
  base: './', // the site may stand in any folder
  publicDir: here('../build/web-public'),
  resolve: { alias: { 'incise/worker': here('../build/npm/worker.mjs'), 'incise/life': here('../build/npm/life.mjs') } },
  worker: { format: 'es', rollupOptions: { external: missing } },
  build: { rollupOptions: { external: missing }, target: 'es2022', outDir: here('../build/site'), emptyOutDir: true, sourcemap: true, chunkSizeWarningLimit: 900, assetsInlineLimit: 0 },
  server: { fs: { allow: [here('..')] } },
};
