// SPDX-License-Identifier: Apache-2.0
import { fileURLToPath } from 'node:url';

const here = (path) => fileURLToPath(new URL(path, import.meta.url));

export default {
  base: './', // the site may stand in any folder
  publicDir: here('../build/web-public'),
  resolve: { alias: { incise: here('../build/npm/index.mjs') } },
  worker: { format: 'es' },
  build: { target: 'es2022', outDir: here('../build/site'), emptyOutDir: true, sourcemap: true, chunkSizeWarningLimit: 900, assetsInlineLimit: 0 },
  server: { fs: { allow: [here('..')] } },
};
