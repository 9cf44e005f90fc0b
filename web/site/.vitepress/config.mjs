// SPDX-License-Identifier: Apache-2.0
// The site: its pages are the documents that stage.mjs has gathered; the page on which a body is cut stands under cut/, the
// reference of the headers under api/. INCISE_SITE_BASE is the folder of the server that it will stand in: /incise/, say.
import { readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';

const here = (path) => fileURLToPath(new URL(path, import.meta.url));
const pages = here('../pages');
const base = process.env.INCISE_SITE_BASE ?? '/';

/** The sidebar: headings and rows of the index of documents. */
function sidebar() {
  const groups = [];
  for (const line of readFileSync(`${pages}/docs/index.md`, 'utf8').split('\n')) {
    const heading = /^## (.+)/.exec(line);
    if (heading) groups.push({ text: heading[1], items: [] });
    if (line.startsWith('|')) for (const [, path] of line.matchAll(/\]\(([^)#]+\.md)\)/g)) groups.at(-1)?.items.push(entry(path));
  }
  return groups.filter(({ items }) => items.length);
}

/** A page in the sidebar, by its own title. */
function entry(path) {
  const page = new URL(path, `file://${pages}/docs/`);
  const title = /^# (.+)/m.exec(readFileSync(fileURLToPath(page), 'utf8'))[1].replaceAll('`', '');
  return { text: title, link: `/${fileURLToPath(page).slice(pages.length + 1).replace(/(index)?\.md$/, '')}` };
}

/** Anchors as the documents' own checks make them. */
const slugify = (text) => text.trim().toLowerCase().replace(/[^\p{L}\p{N}\s_-]/gu, '').replace(/\s/g, '-');

export default {
  title: 'Incise',
  description: 'An open engine that cuts tetrahedral models in real time and keeps the mesh fit to simulate',
  lang: 'en',
  base,
  srcDir: pages,
  outDir: here('../../../build/web-site'),
  cacheDir: here('../../../build/site-cache'),
  head: [['link', { rel: 'icon', href: 'data:,' }]],
  ignoreDeadLinks: [/^\/(cut|api|files)\//], // put there after this is built; check_links.mjs looks at them all
  markdown: { anchor: { slugify }, toc: { slugify } },
  vite: { publicDir: `${pages}/public` },
  themeConfig: {
    search: { provider: 'local' },
    outline: 'deep',
    nav: [
      { text: 'Cut', link: `${base}cut/`, target: '_self' },
      { text: 'Guides', link: '/docs/' },
      { text: 'Results', link: '/docs/results' },
      { text: 'Reference', link: `${base}api/index.html`, target: '_self' },
    ],
    sidebar: sidebar(),
    footer: { message: 'Apache License 2.0. This site asks no other server for anything.' },
  },
};
