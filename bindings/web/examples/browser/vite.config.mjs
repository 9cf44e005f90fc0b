// SPDX-License-Identifier: Apache-2.0
// The module awaits at its top level, which targets before 2022 do not have.
export default { base: './', build: { target: 'es2022', outDir: 'dist-vite' } };
