// SPDX-License-Identifier: Apache-2.0
// The page for those who see little, use no mouse, or bear no motion: labels, contrast, focus, keys.
import assert from 'node:assert/strict';
import { createRequire } from 'node:module';
import { describe, test } from 'node:test';
import { Visit, pictures, skip } from './page_support.mjs';
import { at } from './support.mjs';

const axe = createRequire(at('web/package.json')).resolve('axe-core/axe.min.js');
const RULES = ['wcag2a', 'wcag2aa', 'wcag21a', 'wcag21aa', 'wcag22aa', 'best-practice'];

describe('the page for everyone', { skip }, () => {
  const visit = new Visit();
  const { ask, drag, figures, hint, isAtRest, openPage, press, until } = visit;

  test('breaks no rule of axe, dark and light, small and large, with its panels open', async (context) => {
    let passes = 0;
    for (const colorScheme of ['dark', 'light']) {
      for (const width of [360, 1280]) {
        await openPage({ colorScheme, viewport: { width, height: 800 } });
        for (const key of ['', 'f', 'h']) {
          if (key) await press(key);
          if (!(await visit.page.evaluate(() => window.axe))) await visit.page.addScriptTag({ path: axe });
          const result = await visit.page.evaluate((tags) => window.axe.run({ runOnly: { type: 'tag', values: tags } }), RULES);
          passes += result.passes.length;
          const broken = result.violations.map(({ id, nodes }) => `${id}: ${nodes.map((node) => node.html.slice(0, 80)).join(' | ')}`);
          assert.deepEqual(broken, [], `${colorScheme}, ${width} px, panel '${key}'`);
        }
        await visit.end();
      }
    }
    context.diagnostic(`${passes} rules passed over 12 views`);
    assert.ok(passes > 200, `only ${passes} rules were looked at`);
  });

  /** Of two colours, by WCAG. */
  function contrast(one, other) {
    const linear = (c) => (c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4);
    const light = (rgb) => rgb.slice(0, 3).reduce((sum, c, i) => sum + [0.2126, 0.7152, 0.0722][i] * linear(c), 0);
    const [a, b] = [light(one), light(other)].sort((x, y) => y - x);
    return (a + 0.05) / (b + 0.05);
  }
  const over = ([r, g, b, opacity], ground) => [r, g, b].map((c, i) => opacity * c + (1 - opacity) * ground[i]);

  test('words and controls have contrast in both themes, whatever is behind their panels', async (context) => {
    const least = {};
    for (const colorScheme of ['dark', 'light']) {
      await openPage({ colorScheme });
      const colors = await visit.page.evaluate(() => {
        const pen = Object.assign(document.createElement('canvas'), { width: 1, height: 1 }).getContext('2d', { willReadFrequently: true });
        const style = getComputedStyle(document.documentElement);
        const read = (name) => {
          pen.clearRect(0, 0, 1, 1);
          pen.fillStyle = style.getPropertyValue(name).trim();
          pen.fillRect(0, 0, 1, 1);
          return [...pen.getImageData(0, 0, 1, 1).data].map((each) => each / 255);
        };
        return Object.fromEntries(['panel', 'press', 'text', 'faint', 'accent', 'on-accent', 'line'].map((name) => [name, read(`--${name}`)]));
      });
      // The ground, and the brightest and the darkest of tissue.
      for (const behind of [[0, 0, 0], [1, 1, 1], [0.94, 0.75, 0.66], [0.4, 0.08, 0.08]]) {
        const panel = over(colors.panel, behind);
        const pairs = { text: contrast(colors.text, panel), faint: contrast(colors.faint, panel), control: contrast(colors.accent, panel) };
        pairs.pressed = contrast(colors.text, over(colors.press, panel));
        pairs.chosen = contrast(colors['on-accent'], colors.accent);
        for (const [name, value] of Object.entries(pairs)) least[`${colorScheme} ${name}`] = Math.min(least[`${colorScheme} ${name}`] ?? 99, value);
      }
      await visit.end();
    }
    context.diagnostic(JSON.stringify(Object.fromEntries(Object.entries(least).map(([name, value]) => [name, Number(value.toFixed(2))]))));
    for (const [name, value] of Object.entries(least)) assert.ok(value >= (name.endsWith('control') ? 3 : 4.5), `${name}: ${value}`);
  });

  const focused = () => visit.page.evaluate(() => {
    const { activeElement: at } = document, style = getComputedStyle(at);
    return { id: at.id || at.dataset.tool || at.tagName, isMarked: style.outlineStyle !== 'none' && parseFloat(style.outlineWidth) > 0 };
  });

  test('Tab goes through everything once, in the order in which it is seen, and marks where it is', async () => {
    await openPage();
    const order = [];
    for (let i = 0; i < 13; ++i) {
      await press('Tab');
      const { id, isMarked } = await focused();
      assert.ok(isMarked, `${id} does not show that it has the focus`);
      order.push(id);
    }
    assert.deepEqual(order, ['body', 'open', 'figures-button', 'share', 'shot', 'theme', 'help-button', 'picture', 'Scalpel', 'depth', 'undo', 'redo', 'reset'], order.join(' '));
    await press('Shift+Tab');
    assert.equal((await focused()).id, 'redo');
    const places = await visit.page.evaluate((ids) => ids.map((id) => document.getElementById(id)?.getBoundingClientRect()).map((box) => box && [box.top, box.left]), order.slice(0, 7));
    for (let i = 1; i < places.length; ++i) assert.ok(places[i][0] > places[i - 1][0] || places[i][1] > places[i - 1][1], `${order[i]} comes after ${order[i - 1]}`);
  });

  test('a body is cut, turned and mended by keys alone', async () => {
    await openPage();
    await press('Tab');
    while ((await focused()).id !== 'picture') await press('Tab');
    for (let i = 0; i < 8; ++i) await press('ArrowLeft');
    await press('Space');
    for (let i = 0; i < 16; ++i) {
      await press('ArrowRight');
      await visit.page.waitForTimeout(16);
    }
    await visit.page.screenshot({ path: `${pictures}/keys.png` });
    await press('Space');
    await until(() => window.incise.figures.strokes === 1 && window.incise.figures.cutTets > 0);
    await isAtRest();
    const before = await visit.page.screenshot();
    await press('Shift+ArrowLeft');
    await visit.page.waitForTimeout(500);
    assert.notDeepEqual(await visit.page.screenshot(), before);
    await press('Control+z');
    await until(() => window.incise.figures.strokes === 0);
    await press('Tab');
    await press('ArrowRight');
    assert.equal((await focused()).id, 'Plane cut');
    assert.match(await hint(), /plane/);
    const chooser = visit.page.waitForEvent('filechooser');
    await visit.page.focus('#open');
    await press('Enter');
    await chooser;
  });

  test('what Escape gives up is given up for keys too, and a slider keeps no key from the page', async () => {
    await openPage();
    await visit.page.focus('#picture');
    for (let i = 0; i < 8; ++i) await press('ArrowLeft');
    await press('Space');
    await press('ArrowRight');
    await press('Escape');
    assert.equal(await visit.page.evaluate(() => document.getElementById('cross').classList.contains('down')), false);
    await press('Space');
    for (let i = 0; i < 16; ++i) {
      await press('ArrowRight');
      await visit.page.waitForTimeout(16);
    }
    await press('Space');
    await until(() => window.incise.figures.strokes > 0);
    await visit.page.focus('#depth');
    await press('Control+z');
    await until(() => window.incise.figures.strokes === 0);
    await press('h');
    assert.equal(await visit.page.evaluate(() => document.getElementById('help').hidden), false);
  });

  test('who bears no motion sees no animation, and a recording at its end', async () => {
    await openPage();
    await drag([0.4, 0.45], [0.6, 0.5]);
    await until(() => window.incise.figures.strokes === 1);
    await isAtRest();
    const hash = await ask('hash');
    await visit.page.click('#share');
    await until(() => location.hash.includes('r='));
    const path = new URL(visit.page.url()).hash;
    await visit.end();
    await openPage({ path, reducedMotion: 'reduce', waits: false });
    await until(() => window.incise?.state === 'ready');
    assert.equal((await visit.page.evaluate(() => window.incise.replayed)).hash, hash);
    assert.equal((await figures()).strokes, 1); // in the first picture
    await visit.page.hover('#theme');
    assert.equal(await visit.page.evaluate(() => document.getAnimations().length), 0);
  });
});
