// SPDX-License-Identifier: Apache-2.0
// Gathers the documents of the repository as pages of the site: follows their links from docs/ on, gives README.md of a
// folder the name index.md, and publishes the other files that they point to as text under files/.
// usage: node site/stage.mjs FOLDER      the folder is made anew
import { copyFileSync, existsSync, mkdirSync, readFileSync, readdirSync, rmSync, statSync, writeFileSync } from 'node:fs';
import { dirname, join, posix, relative } from 'node:path';
import { fileURLToPath } from 'node:url';

const root = fileURLToPath(new URL('../..', import.meta.url));
const here = fileURLToPath(new URL('.', import.meta.url));
const IMAGE = /\.(png|svg|jpe?g|gif)$/;

/** The page that a document becomes: README.md is what a folder shows; the repository's own is about the whole. */
export const pageOf = (path) => (path === 'README.md' ? 'overview.md' : path.replace(/(^|\/)README\.md$/, '$1index.md'));

/** What a relative link of the document `from` leads to: `{page}`, `{image}` or `{file}`, with its path in the repository. */
function targetOf(from, href) {
  const path = posix.normalize(posix.join(posix.dirname(from), decodeURIComponent(href))).replace(/\/$/, '');
  const full = join(root, path);
  if (path.startsWith('..') || !existsSync(full)) throw new Error(`${from}: there is no ${href}; mend the link`);
  if (!statSync(full).isDirectory()) return path.endsWith('.md') ? { page: path } : IMAGE.test(path) ? { image: path } : { file: path };
  if (existsSync(join(full, 'README.md'))) return { page: posix.join(path, 'README.md') };
  return { folder: path };
}

/** A document's title, for links whose words are the name of its file. */
const titleOf = (path) => /^# (.+)/m.exec(readFileSync(join(root, path), 'utf8'))[1];

/** A link to a file or a folder of the repository, as the site publishes it. */
const published = (target) => (target.file ? `/files/${target.file}.txt` : `/files/${target.folder}/index.txt`);

/** The text of a document with its links as those of the page `to`; `meet` is told of each thing linked to. */
function withLinksOf(text, from, to, meet) {
  const link = (whole, href, hash = '') => {
    if (/^(\w+:|\/|$)/.test(href)) return whole;
    const target = targetOf(from, href);
    meet(target);
    const goal = target.page ?? target.image;
    if (!goal) return `](${published(target)})`;
    const path = posix.relative(posix.dirname(to), target.page ? pageOf(goal) : goal);
    return `](${path.startsWith('.') ? path : `./${path}`}${hash})`;
  };
  const title = (whole, name, href) => `[${titleOf(targetOf(from, href).page)}](${href}`;
  return outsideOfCode(text, (part) => part.replace(/\[([\w-]+\.md)\]\(([^)#\s]*\1)/g, title).replace(/\]\(([^)#\s]*)(#[^)\s]*)?\)/g, link));
}

/** Changes the text but for its blocks of code and its code in lines. */
function outsideOfCode(text, change) {
  return text.split(/(^```[\s\S]*?^```$|`[^`\n]+`)/m).map((part, k) => (k % 2 ? part : change(part))).join('');
}

/** Braces in pairs, which the site's generator would take for its own. */
const plain = (text) => outsideOfCode(text, (part) => part.replaceAll('{{', '{\u200b{'));

/** The section of a document under a heading, without it, its links those of the page `to`. */
function sectionOf(path, heading, to, meet) {
  const text = readFileSync(join(root, path), 'utf8');
  const start = text.indexOf(`\n## ${heading}\n`);
  if (start < 0) throw new Error(`web/site/index.md: ${path} has no heading '${heading}'`);
  const body = text.slice(start + heading.length + 5);
  const end = body.search(/^## /m);
  return withLinksOf(end < 0 ? body : body.slice(0, end), path, to, meet);
}

/** Writes the site's sources to the folder `out`. */
export function stage(out) {
  rmSync(out, { recursive: true, force: true });
  const write = (path, text) => {
    mkdirSync(dirname(join(out, path)), { recursive: true });
    writeFileSync(join(out, path), text);
  };
  const copy = (path, to) => {
    mkdirSync(dirname(join(out, to)), { recursive: true });
    copyFileSync(join(root, path), join(out, to));
  };
  const seen = new Set();
  const queue = [];
  const meet = (target) => {
    const path = target.page ?? target.image ?? target.file ?? target.folder;
    if (seen.has(path)) return;
    seen.add(path);
    if (target.page) queue.push(path);
    else if (target.image) copy(path, path);
    else if (target.file) copy(path, `public${published(target)}`);
    else write(`public${published(target)}`, `${readdirSync(join(root, path)).sort().join('\n')}\n`);
  };
  const own = withLinksOf(readFileSync(join(here, 'index.md'), 'utf8'), 'web/site/index.md', 'index.md', meet);
  const front = own
    .replace(/src="\.\.\/\.\.\/([^"]+)"/g, (_, path) => (meet({ image: path }), `src="./${path}"`))
    .replace(/^<!-- section: (\S+) (.+) -->$/gm, (_, path, heading) => sectionOf(path, heading, 'index.md', meet));
  write('index.md', front);
  copy('docs/figures/figure11c.png', 'public/hero.png');
  for (const name of readdirSync(join(root, 'docs')).filter((name) => name.endsWith('.md'))) meet({ page: `docs/${name}` });
  for (let path; (path = queue.shift()); ) write(pageOf(path), plain(withLinksOf(readFileSync(join(root, path), 'utf8'), path, pageOf(path), meet)));
  return [...seen];
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  const out = process.argv[2];
  console.error(`site: ${stage(out).length} documents and files in ${relative(process.cwd(), out)}`);
}
