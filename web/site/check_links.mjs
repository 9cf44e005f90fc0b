// SPDX-License-Identifier: Apache-2.0
// Checks that every link, picture, script and anchor in the pages of a built site exists, and that nothing is asked of
// another server.
// usage: node site/check_links.mjs FOLDER [BASE]
import { existsSync, readFileSync, readdirSync, statSync } from 'node:fs';
import { join, posix } from 'node:path';
import { fileURLToPath } from 'node:url';

/** All pages below a folder but for those of the reference, whose generator checks its own. */
function pagesOf(folder, under = '') {
  return readdirSync(join(folder, under), { withFileTypes: true }).flatMap((entry) => {
    const path = posix.join(under, entry.name);
    if (entry.isDirectory()) return path === 'api' ? [] : pagesOf(folder, path);
    return path.endsWith('.html') ? [path] : [];
  });
}

const without = (text, pattern) => text.replace(pattern, '');
const decoded = (text) => decodeURIComponent(text.replaceAll('&amp;', '&').replaceAll('&#39;', "'"));

/** What is wrong with the links of a built site that stands at `base`: one line each. */
export function brokenLinks(folder, base = '/') {
  const texts = new Map();
  const textOf = (path) => texts.get(path) ?? texts.set(path, readFileSync(join(folder, path), 'utf8')).get(path);
  const complaints = [];
  for (const page of pagesOf(folder)) {
    const text = without(textOf(page), /<(script|pre|code)\b[^>]*>[\s\S]*?<\/\1>/g);
    for (const [, tag, attribute, value] of text.matchAll(/<(\w+)\b[^>]*?\s(href|src)="([^"]*)"/g)) {
      const isOutside = /^([a-z]+:)?\/\//.test(value);
      if (isOutside && tag !== 'a') complaints.push(`${page}: asks another server: ${value}`);
      if (isOutside || /^(mailto|data|javascript):/.test(value)) continue;
      const [path, hash] = value.split('#').map(decoded);
      if (path.startsWith('/') && !path.startsWith(base)) complaints.push(`${page}: ${value} is not below ${base}`);
      let target = path === '' ? page : path.startsWith('/') ? path.slice(base.length) : posix.join(posix.dirname(page), path);
      if (target === '' || target.endsWith('/') || (existsSync(join(folder, target)) && statSync(join(folder, target)).isDirectory())) target = posix.join(target, 'index.html');
      if (!existsSync(join(folder, target))) complaints.push(`${page}: there is no ${attribute} ${value}`);
      else if (hash && target.endsWith('.html') && !textOf(target).includes(`id="${hash}"`)) complaints.push(`${page}: ${target} has no anchor #${hash}`);
    }
  }
  return complaints;
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  const complaints = brokenLinks(process.argv[2], process.argv[3]);
  for (const line of complaints) console.error(line);
  console.error(`site: ${complaints.length} wrong links`);
  process.exit(complaints.length ? 1 : 0);
}
