// SPDX-License-Identifier: Apache-2.0
// What people open: a mesh, a scene or a recording, and what that names beside itself.
const LARGEST = 200e6; // bytes of one file; a mesh of some two million tets
const LARGEST_TEXT = 4e6; // bytes of a scene, or of a recording's first line
const NAME = /^[^\n]{1,255}\.(mesh|msh2?|vtk|vtu|node|ele|veg|inp|ply|off|obj|stl|json)(\.gz)?$/i;
const PAIR = /^(.*)\.(node|ele)((?:\.gz)?)$/i; // TetGen's files come in pairs

const lastPart = (path) => path.split(/[\\/]/).pop();
/** Names that stand for one file: systems write them in capitals or not, and accents as one letter or as two. */
const keyOf = (name) => lastPart(name).normalize('NFC').toLowerCase();
const isRecording = (name) => /\.jsonl$/i.test(name);
const isScene = (name) => /\.json$/i.test(name);
/** Of files that are opened together the first is what is shown; the others lie beside it. */
const rank = ({ name }) => [isRecording(name), isScene(name), !/\.ele$/i.test(name), true].indexOf(true);

/** What a file of a pair asks for: the other one, by the name that the reader looks for. */
function partnerOf(name) {
  const [, stem, end] = PAIR.exec(name) ?? [];
  return end ? `${stem}.${end.toLowerCase() === 'node' ? 'ele' : 'node'}` : null;
}

/**
 * The files that a file needs, without their folders: those that a scene or a recording names, none where it cannot be read as one,
 * and a pair's other half. `isKnown`: whether there is a file of a name whose end tells nothing.
 */
export function namesIn(name, bytes, isKnown = () => false) {
  if (!isRecording(name) && !isScene(name)) return [partnerOf(lastPart(name))].filter(Boolean);
  const line = isRecording(name) ? bytes.indexOf(10) : -1;
  const text = new TextDecoder().decode(bytes.subarray(0, Math.min(line < 0 ? bytes.length : line, LARGEST_TEXT)));
  const names = new Set();
  try {
    JSON.parse(text, (key, value) => {
      if (typeof value === 'string' && (NAME.test(value) || isKnown(value))) names.add(lastPart(value));
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

/** Of files by name the one that a name stands for: [name, bytes]. */
function find(files, name) {
  if (Object.hasOwn(files, name)) return [name, files[name]];
  return Object.entries(files).find(([each]) => keyOf(each) === keyOf(name));
}

/** The bytes by name of files that were chosen. Throws where two have one name. */
async function read(chosen) {
  const files = {};
  for (const file of chosen) {
    if (Object.hasOwn(files, file.name)) throw new Error(`two files are called ${file.name}: choose one of them`);
    files[file.name] = await bytesOf(file);
  }
  return files;
}

/**
 * What a session is opened with, of files that were chosen together; what they name and do not bring may be open already, or be one
 * of the page's own. `missing`: the names that are found nowhere. `leftOut`: those of files that nothing needs.
 *
 * @param isOpen  name to bytes, of what is open
 * @param page  names of the page's own files
 * @param fetchBytes  of one of these
 */
export async function gather(chosen, isOpen, page, fetchBytes) {
  const [{ name }, ...others] = [...chosen].sort((a, b) => rank(a) - rank(b));
  const given = await read(chosen), bytes = given[name], files = {}, missing = [], used = new Set([name]);
  const isKnown = (value) => Boolean(find(given, value) ?? find(isOpen, value));
  const ofPage = async (named) => {
    const own = page.find((each) => keyOf(each) === keyOf(named));
    return own && [own, await fetchBytes(own)];
  };
  const wanted = [[name, bytes, isRecording(name) || isScene(name)]];
  for (const [asking, text, mayBeOpen] of wanted) {
    for (const named of namesIn(asking, text, isKnown)) {
      if (keyOf(named) === keyOf(name) || files[named]) continue;
      const [found, content] = find(given, named) ?? find(mayBeOpen ? isOpen : {}, named) ?? (await ofPage(named)) ?? [];
      if (!content) {
        missing.push(named);
        continue;
      }
      used.add(found);
      files[named] = content; // by the name that is asked for
      wanted.push([named, content, mayBeOpen]);
    }
  }
  const leftOut = others.filter((other) => !used.has(other.name)).map((other) => other.name);
  return { what: { bytes, name, files }, missing, leftOut };
}
