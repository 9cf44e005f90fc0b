// SPDX-License-Identifier: Apache-2.0
// The panel of figures: what a frame brings, and what is asked for once a second while it is shown.
import { drawHistogram } from './histogram.mjs';
import { grouped } from './numbers.mjs';

const $ = (id) => document.getElementById(id);
const show = (id, text) => ($(id).textContent = text);
const SHOW_MS = 200; // figures that change faster cannot be read

export class Panel {
  #shownAt = 0;
  #figures = null;
  #isAsking = false;

  /** @param ask  of the engine; what it returns is null while there is none */
  constructor(ask) {
    this.ask = ask;
  }

  get isShown() {
    return !$('figures').hidden;
  }

  take(figures) {
    this.#figures = figures;
    if (performance.now() - this.#shownAt > SHOW_MS) this.#show();
  }

  #show() {
    if (!this.isShown || !this.#figures) return;
    this.#shownAt = performance.now();
    const { tetsAtStart, tets, strokes, force, peakForce, frameMs, rate } = this.#figures;
    show('f-tets', `${grouped(tetsAtStart)} → ${grouped(tets)}`);
    show('f-strokes', strokes);
    show('f-force', `${force.toFixed(2)} N, peak ${peakForce.toFixed(2)}`);
    show('f-frame', `${frameMs.toFixed(1)} ms`);
    show('f-rate', `${rate.toFixed(0)} frames/s`);
  }

  /** Asks for quality and hash, unless it is asking already. */
  async refresh() {
    if (!this.isShown || this.#isAsking) return;
    this.#show(); // at rest no frames come
    this.#isAsking = true;
    try {
      const quality = await this.ask('quality');
      if (!quality) return;
      const { now, before, pieces } = quality;
      show('f-pieces', pieces);
      show('f-mean', `${before.lrMean.toFixed(2)} → ${now.lrMean.toFixed(2)}`);
      show('f-worst', `${before.lrMax.toFixed(1)} → ${now.lrMax.toFixed(1)}`);
      show('f-hash', await this.ask('hash'));
      const style = getComputedStyle(document.documentElement);
      drawHistogram($('histogram'), before.histogram, now.histogram, style.getPropertyValue('--accent'), style.getPropertyValue('--text'));
    } finally {
      this.#isAsking = false;
    }
  }
}
