// SPDX-License-Identifier: Apache-2.0
// A recording as the part of an address after #, which is never sent to a server.
const KEY = 'r=';
/** Longer links are cut off by what people paste them into. */
export const LONGEST_LINK = 200_000;
const LARGEST = 64e6; // bytes of what a link unpacks to

async function through(bytes, stream) {
  const parts = [];
  let size = 0;
  for (const reader = new Blob([bytes]).stream().pipeThrough(stream).getReader(); ; ) {
    const { done, value } = await reader.read();
    if (done) return new Uint8Array(await new Blob(parts).arrayBuffer());
    parts.push(value);
    size += value.length;
    if (size <= LARGEST) continue;
    await reader.cancel();
    throw new Error('too large for a link');
  }
}

export async function toFragment(body, recording) {
  const packed = await through(recording, new CompressionStream('deflate-raw'));
  let text = '';
  for (let i = 0; i < packed.length; i += 8192) text += String.fromCharCode(...packed.subarray(i, i + 8192));
  const safe = btoa(text).replaceAll('+', '-').replaceAll('/', '_').replaceAll('=', '');
  return `#b=${encodeURIComponent(body)}&${KEY}${safe}`;
}

/** The body and the recording of an address; nothing where it has none. Throws where it is damaged. */
export async function fromFragment(fragment) {
  const parts = Object.fromEntries(fragment.replace(/^#/, '').split('&').map((part) => [part.slice(0, 2), part.slice(2)]));
  if (!parts[KEY]) return null;
  const text = atob(parts[KEY].replaceAll('-', '+').replaceAll('_', '/'));
  const packed = Uint8Array.from(text, (c) => c.charCodeAt(0));
  return { body: decodeURIComponent(parts['b='] ?? ''), recording: await through(packed, new DecompressionStream('deflate-raw')) };
}
