// SPDX-License-Identifier: Apache-2.0
// What people open: a mesh, a scene or a recording, and what that names beside itself.
const LARGEST = 200e6; // bytes of one file; a mesh of some two million tets
const LARGEST_TEXT = 4e6; // bytes of a scene, or of a recording's first line
const NAME = /^[^\n]{1,255}\.(mesh|msh2?|vtk|vtu|node|ele|veg|inp|ply|off|obj|stl|json)$/i;

const lastPart = (path) => path.split(/[\\/]/).pop();
const isRecording = (name) => /\.jsonl$/i.test(name);
const isScene = (name) => /\.json$/i.test(name);
/** Of files that are opened together the first is what is shown; the others lie beside it. */
const rank = ({ name }) => [isRecording(name), isScene(name), !/\.ele$/i.test(name), true].indexOf(true);

/** The files that a scene or a recording names, without their folders; none where it cannot be read as one. */
export function namesIn(name, bytes) {
  if (!isRecording(name) && !isScene(name)) return [];
  const line = isRecording(name) ? bytes.indexOf(10) : -1;
  const text = new TextDecoder().decode(bytes.subarray(0, Math.min(line < 0 ? bytes.length : line, LARGEST_TEXT)));
  const names = new Set();
  try {
    JSON.parse(text, (key, value) => {
      if (typeof value === 'string' && NAME.test(value)) names.add(lastPart(value));
      return value;
    });
  } catch {
    return []; // whoever opens it says what is wrong
  }
  return [...names];
}

async function bytesOf(file) {
  if (file.size > LARGEST) throw new Error(`${file.name} is larger than ${LARGEST / 1e6} MB; use the window or the command`);
  return new Uint8Array(await file.arrayBuffer());
}

/**
 * What a session is opened with, of files that were chosen together; what they name and do not bring may be open already, or be one
 * of the page's own. `missing`: the names that are found nowhere.
 *
 * @param isOpen  name to bytes, of what is open
 * @param page  names of the page's own files
 * @param fetchBytes  of one of these
 */
export async function gather(chosen, isOpen, page, fetchBytes) {
  const [main, ...others] = [...chosen].sort((a, b) => rank(a) - rank(b));
  const bytes = await bytesOf(main), files = {}, missing = [];
  for (const file of others) files[file.name] = await bytesOf(file);
  const wanted = [[main.name, bytes]];
  for (const [name, text] of wanted) {
    for (const named of namesIn(name, text)) {
      if (named === main.name) continue;
      files[named] ??= isOpen[named] ?? (page.includes(named) ? await fetchBytes(named) : undefined);
      if (files[named]) wanted.push([named, files[named]]);
      else missing.push(named);
    }
  }
  return { what: { bytes, name: main.name, files: Object.fromEntries(Object.entries(files).filter(([, found]) => found)) }, missing };
}
