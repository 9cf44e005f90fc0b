// SPDX-License-Identifier: Apache-2.0
// What the page looks like: pictures against golden ones, and nothing that overflows. What is seen is a recording's end, so that it is
// the same on every machine, bit for bit; it is drawn by a processor.
import assert from 'node:assert/strict';
import { describe, test } from 'node:test';
import { shareOffGolden } from './golden_picture.mjs';
import { Visit, pictures, skip } from './page_support.mjs';
import { at, read } from './support.mjs';

const MOST_OFF = 0.015; // of the pixels
const { load } = await import(at('build/npm/index.mjs'));

/** The recording of drags over the patch: [tool, from, to] in pixels of a picture of 800 × 600. */
async function recordingOf(...drags) {
  const { Session } = await load(), session = Session.open(read('scenes/web_patch.json'), 'patch.json');
  session.resize(800, 600);
  session.depth = 0.5;
  for (const [tool, from, to] of drags) {
    session.refresh();
    session.tool = tool;
    session.pointer('press', ...from);
    for (let i = 1; i <= 40; ++i) {
      session.pointer('move', from[0] + ((to[0] - from[0]) * i) / 40, from[1] + ((to[1] - from[1]) * i) / 40);
      session.frame();
      session.refresh();
    }
    session.pointer('release', ...to);
    for (let i = 0; i < 40; ++i) session.frame();
  }
  return Buffer.from(session.recording());
}

const CUT = ['Scalpel', [270, 285], [530, 300]];
const OPENED = [CUT, ['Retractor', [385, 283], [370, 215]], ['Retractor', [395, 302], [410, 385]]];

describe('the look of the page', { skip }, () => {
  const visit = new Visit();
  const { isAtRest, openPage, press, until } = visit;
  const BARE = 'header, footer, aside { visibility: hidden }';

  async function see({ drags = [], ...options }) {
    await openPage({ path: '?look=full', reducedMotion: 'reduce', colorScheme: 'dark', ...options });
    if (drags.length > 0) {
      await visit.page.setInputFiles('#file', { name: 'drags.jsonl', mimeType: 'text/plain', buffer: await recordingOf(...drags) });
      await until(() => window.incise.replayed && window.incise.state === 'ready');
      assert.match((await visit.page.evaluate(() => window.incise.replayed)).verdict, /^End: the same state/);
    }
    await isAtRest();
    await visit.page.mouse.move(2, 2);
    await visit.page.waitForTimeout(400);
  }

  async function isAsGolden(context, name, style = '') {
    const picture = await visit.page.screenshot({ path: `${pictures}/look_${name}.png`, style });
    const share = shareOffGolden(picture, name);
    context.diagnostic(`${name}: ${(100 * share).toFixed(2)} % of the pixels differ`);
    assert.ok(share <= MOST_OFF, `${name} differs from its golden picture in ${(100 * share).toFixed(2)} % of the pixels`);
  }

  test('the first view', async (context) => {
    await see({});
    await isAsGolden(context, 'first', BARE);
  });

  test('a cut', async (context) => {
    await see({ drags: [CUT] });
    await isAsGolden(context, 'cut', BARE);
  });

  test('a wound that is drawn open, with layers on its walls', async (context) => {
    await see({ drags: OPENED });
    await isAsGolden(context, 'opened', BARE);
  });

  test('the whole page, light and dark, small and large', async (context) => {
    for (const [name, options] of Object.entries({
      light: { colorScheme: 'light' }, 'dark-360': { viewport: { width: 360, height: 740 } }, 'dark-2560': { viewport: { width: 2560, height: 1440 } },
    })) {
      await see({ drags: [CUT], ...options });
      await isAsGolden(context, name, '#hint { visibility: hidden }');
      await visit.end();
    }
  });

  /** What can be pressed or read and is not all in sight. */
  const outside = () => visit.page.evaluate(() => [...document.querySelectorAll('button, select, input:not([hidden]), h1')]
    .filter((each) => {
      const box = each.getBoundingClientRect();
      return box.width > 0 && (box.left < 0 || box.right > innerWidth || box.top < 0 || box.bottom > innerHeight);
    }).map((each) => each.id || each.textContent));

  test('nothing is out of sight at widths between', async () => {
    await openPage();
    for (const [width, height] of [[320, 568], [500, 320], [521, 600], [568, 320], [600, 800], [667, 375], [700, 500], [740, 360], [761, 600], [800, 600]]) {
      await visit.page.setViewportSize({ width, height });
      assert.deepEqual(await outside(), [], `${width} px`);
      const free = await visit.page.evaluate(() => document.querySelector('footer').getBoundingClientRect().top - document.querySelector('header').getBoundingClientRect().bottom);
      assert.ok(free > 0.5 * height || height > 450, `${free} of ${width} x ${height} px are left`);
      if (height === 320) await visit.page.screenshot({ path: `${pictures}/${width}x320.png` });
      for (const [key, id] of [['f', 'figures'], ['h', 'help']]) {
        await press(key);
        const [panel, bar] = await Promise.all([`#${id}`, '#bar'].map((what) => visit.page.locator(what).boundingBox()));
        assert.ok(panel.height >= 120 && (panel.y + panel.height <= bar.y || height < 400), `${id} at ${width} px: ${JSON.stringify([panel, bar])}`);
        if (width === 320) await visit.page.screenshot({ path: `${pictures}/320-${id}.png` });
        await press('Escape'); // closes it
        assert.equal(await visit.page.locator(`#${id}`).isVisible(), false);
      }
    }
    await visit.end();
  });

  test('nothing overflows from 360 to 2560 pixels, dark and light', async () => {
    for (const [width, height] of [[360, 740], [1280, 800], [2560, 1440]]) {
      for (const colorScheme of ['dark', 'light']) {
        await openPage({ viewport: { width, height }, colorScheme });
        await visit.drag([0.42, 0.42], [0.62, 0.5]);
        await until(() => window.incise.figures.strokes === 1);
        await isAtRest();
        await visit.page.screenshot({ path: `${pictures}/${width}-${colorScheme}.png` });
        assert.deepEqual(await outside(), [], `${width} px`);
        await press('f');
        await until(() => document.getElementById('f-pieces').textContent === '1');
        await visit.page.screenshot({ path: `${pictures}/${width}-${colorScheme}-figures.png` });
        await visit.end();
      }
    }
  });
});
