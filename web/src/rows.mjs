// SPDX-License-Identifier: Apache-2.0
// Arrays of the engine as the attributes of a geometry.
import { BufferAttribute, DynamicDrawUsage, InstancedInterleavedBuffer, IntType, InterleavedBuffer, InterleavedBufferAttribute } from 'three';

/** An array with room to grow, so that buffers are not made anew every frame. */
function roomy(array, width) {
  const room = new array.constructor(Math.ceil((1.5 * array.length) / width + 16) * width);
  room.set(array);
  return room;
}

/** Whether the array fits into the buffer without wasting it; it is then there. */
function refill(buffer, array) {
  if (!buffer || buffer.array.length < array.length || buffer.array.length > 4 * array.length + 4096) return false;
  buffer.array.set(array);
  buffer.clearUpdateRanges();
  buffer.addUpdateRange(0, array.length);
  buffer.needsUpdate = true;
  return true;
}

/** One attribute of its own. */
export function put(geometry, name, array, width) {
  if (refill(geometry.getAttribute(name), array)) return;
  const attribute = new BufferAttribute(roomy(array, width), width);
  attribute.setUsage(DynamicDrawUsage);
  if (array instanceof Uint8Array) attribute.gpuType = IntType;
  geometry.setAttribute(name, attribute);
}

/** Rows of numbers as attributes: `layout` has the name and the numbers of each. Returns how many rows there are. */
export function putRows(geometry, array, layout, isInstanced) {
  const width = layout.reduce((sum, [, numbers]) => sum + numbers, 0);
  const old = geometry.getAttribute(layout[0][0])?.data;
  if (!refill(old, array)) {
    const buffer = new (isInstanced ? InstancedInterleavedBuffer : InterleavedBuffer)(roomy(array, width), width);
    buffer.setUsage(DynamicDrawUsage);
    let offset = 0;
    for (const [name, numbers] of layout) {
      geometry.setAttribute(name, new InterleavedBufferAttribute(buffer, numbers, offset));
      offset += numbers;
    }
    geometry._maxInstanceCount = undefined; // three.js keeps that of the first buffer
  }
  return array.length / width;
}
