// SPDX-License-Identifier: Apache-2.0
// A visit of the page in headless Chromium, with mouse and touch events as a person makes them; nothing may complain while it lasts.
import assert from 'node:assert/strict';
import { mkdirSync } from 'node:fs';
import { after, afterEach, before, beforeEach } from 'node:test';
import { at, executablePath, launch, serve } from './support.mjs';

export const pictures = at('build/web-pictures');
export const skip = executablePath ? false : 'Chromium is not installed: script/bootstrap --web';

/** What a processor that draws says of itself, which no visitor's driver does. */
const isOfDriver = (text) => /GPU stall due to ReadPixels|GL Driver Message/.test(text);

/** To be made in a `describe`: it adds what goes before and after each of its tests. */
export class Visit {
  page = null;
  complaints = [];
  failures = 0; // of calls, that the test expects
  fetched = new Set(); // paths of what the page asked its server for
  #browser;
  #server;

  constructor(...flags) {
    before(async () => {
      mkdirSync(pictures, { recursive: true });
      this.#server = await serve(at('build/site'));
      this.#browser = await launch(...flags);
    });
    after(async () => {
      await this.#browser?.close();
      this.#server?.close();
    });
    beforeEach(() => {
      this.complaints = [];
      this.failures = 0;
    });
    afterEach(() => this.end());
  }

  get url() {
    return this.#server.url;
  }

  end = async () => {
    const found = await this.page?.evaluate(() => window.incise?.failures ?? []).catch(() => []);
    if (found && found.length !== this.failures) this.complaints.push(`${found.length} failures, expected ${this.failures}: ${found.join('; ')}`);
    await this.page?.context().close();
    this.page = null;
    assert.deepEqual(this.complaints, []);
  };

  openPage = async ({ path = '', waits = true, script, ...options } = {}) => {
    const context = await this.#browser.newContext({ viewport: { width: 960, height: 640 }, acceptDownloads: true, ...options });
    const page = (this.page = await context.newPage()), { url } = this.#server;
    page.on('pageerror', (error) => this.complaints.push(String(error)));
    page.on('console', (message) => ['error', 'warning'].includes(message.type()) && !isOfDriver(message.text()) && this.complaints.push(message.text()));
    page.on('request', (request) => request.url().startsWith(url) && this.fetched.add(new URL(request.url()).pathname.replace(/\/$/, '/index.html')));
    page.on('request', (request) => new URL(request.url()).protocol === 'http:' && !request.url().startsWith(url) && this.complaints.push(`asks ${request.url()}`));
    if (script) await page.addInitScript(script);
    await page.goto(url + path);
    if (waits) await this.isReady();
    return page;
  };

  /** One of the page's workers: 'worker_thread' computes, 'drawing_thread' draws. */
  workerOf = (name) => this.page.workers().find((worker) => worker.url().includes(name));

  isReady = () => this.page.waitForFunction(() => window.incise?.state === 'ready', null, { timeout: 60_000 });
  figures = () => this.page.evaluate(() => window.incise.figures);
  ask = (what) => this.page.evaluate((name) => window.incise.engine.ask(name), what);
  hint = () => this.page.locator('#hint').textContent();
  until = (what, argument) => this.page.waitForFunction(what, argument, { timeout: 60_000 });
  press = (keys) => this.page.keyboard.press(keys);
  isAtRest = () => this.until(() => window.incise.isAwake === false);

  /** A place of the picture, in shares of it. */
  place = ([x, y]) => {
    const { width, height } = this.page.viewportSize();
    return [x * width, y * height];
  };

  /** A drag by the mouse. */
  drag = async (from, to, { steps = 20, button = 'left', pause = 10 } = {}) => {
    const { mouse } = this.page;
    const along = (t) => this.place([0, 1].map((i) => from[i] + (to[i] - from[i]) * t));
    await mouse.move(...along(0));
    await mouse.down({ button });
    for (let i = 1; i <= steps; ++i) {
      await mouse.move(...along(i / steps));
      await this.page.waitForTimeout(pause);
    }
    await mouse.up({ button });
  };
}
