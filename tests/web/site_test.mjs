// SPDX-License-Identifier: Apache-2.0
// The site that `script/web site` makes: its links, its slider, its search, and the page that is part of it.
import assert from 'node:assert/strict';
import { existsSync, mkdirSync } from 'node:fs';
import { after, afterEach, before, describe, test } from 'node:test';
import { brokenLinks } from '../../web/site/check_links.mjs';
import { at, executablePath, launch, serve } from './support.mjs';

const folder = at('build/web-site');
const pictures = at('build/web-pictures');
const missing = existsSync(folder) ? executablePath ? false : 'Chromium is not installed: script/bootstrap --web' : 'script/web site has not been run';

describe('the site', { skip: missing }, () => {
  let browser, server, page;
  const complaints = [];

  before(async () => {
    mkdirSync(pictures, { recursive: true });
    server = await serve(folder);
    browser = await launch();
  });
  after(async () => {
    await browser?.close();
    server?.close();
  });
  afterEach(async () => {
    await page?.close();
    page = null;
    assert.deepEqual(complaints.splice(0), []);
  });

  async function open(path, options = {}) {
    page = await browser.newPage({ viewport: { width: 1280, height: 800 }, ...options });
    page.on('pageerror', (error) => complaints.push(String(error)));
    page.on('console', (message) => message.type() === 'error' && complaints.push(message.text()));
    page.on('request', (request) => !/^(data|blob):/.test(request.url()) && !request.url().startsWith(server.url) && complaints.push(`asks ${request.url()}`));
    await page.goto(server.url + path, { waitUntil: 'networkidle' });
  }

  test('has no wrong link, and asks no other server', () => {
    assert.deepEqual(brokenLinks(folder), []);
    for (const path of ['index.html', 'docs/index.html', 'docs/decisions/index.html', 'cut/index.html', 'api/index.html']) assert.ok(existsSync(at('build/web-site', path)), path);
  });

  test('shows the cut before and after as far as the slider stands', async () => {
    await open('');
    const shown = () => page.locator('.before-after .before').evaluate((each) => getComputedStyle(each).clipPath);
    const slider = page.locator('.before-after input');
    await slider.scrollIntoViewIfNeeded();
    const middle = await shown();
    await slider.focus();
    await page.keyboard.press('Home');
    const none = await shown();
    assert.notEqual(none, middle);
    const { x, y, width, height } = await slider.boundingBox();
    await page.mouse.click(x + 0.8 * width, y + height / 2);
    await page.waitForFunction((was) => getComputedStyle(document.querySelector('.before-after .before')).clipPath !== was, none);
    await page.screenshot({ path: `${pictures}/site.png` });
  });

  test('leads from its first page to a body that can be cut', async () => {
    await open('');
    await page.click('text=Cut one here');
    await page.waitForFunction(() => window.incise?.state === 'ready', null, { timeout: 60_000 });
  });

  test('finds words in the documents', async () => {
    await open('docs/');
    await page.keyboard.press('Control+k');
    await page.fill('.VPLocalSearchBox input', 'toughness'); // waits for the box, which is fetched when it is first asked for
    await page.waitForSelector('.VPLocalSearchBox .result');
    await page.keyboard.press('Enter');
    await page.waitForFunction(() => !location.pathname.endsWith('/docs/'));
  });

  test('overflows on no screen, dark or light', async () => {
    for (const colorScheme of ['dark', 'light']) {
      for (const width of [360, 768, 2560]) {
        for (const path of ['', 'docs/', 'docs/scenes.html', 'docs/results.html']) {
          await open(path, { viewport: { width, height: 800 }, colorScheme });
          const wide = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
          assert.ok(wide <= 0, `${path} is ${wide} pixels too wide on ${width}`);
          await page.screenshot({ path: `${pictures}/site_${path.replace(/\W/g, '_')}_${width}_${colorScheme}.png` });
          await page.close();
        }
      }
    }
  });
});
