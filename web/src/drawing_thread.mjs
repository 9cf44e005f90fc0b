// SPDX-License-Identifier: Apache-2.0
// The worker that draws.
import { holdLife } from 'incise/life';
import { Drawer } from './drawer.mjs';

const drawer = (globalThis.drawer = new Drawer((message) => postMessage(message)));
onmessage = ({ data }) => drawer.hear(data);
holdLife((lock) => postMessage({ type: 'alive', lock }));
