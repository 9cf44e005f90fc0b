// SPDX-License-Identifier: Apache-2.0
// The page's side of drawing: a canvas that a worker draws on, so that the page answers whatever a driver does. Where browsers cannot
// hand a canvas over, the page draws itself.
import { watchLife } from 'incise/life';

const MOST_DEATHS = 3; // of workers: a further one would die, too

/** Events: `begun` {renderer, level}, `drawn` {ms}, `level` {level}, `lost`, `restored`, `unable` ({why}: what stopped worker after worker; none without WebGL 2), and `replaced` after its worker died. */
export class Drawing extends EventTarget {
  #holder;
  #worker = null;
  #drawer = null;
  #endWatch = () => {};
  #state; // what another worker would need
  #shots = [];
  #deaths = 0;
  isBusy = false;

  /** @param holder  of the canvas, which is made anew when a worker dies */
  constructor(holder, { look, size, level }) {
    super();
    this.#holder = holder;
    this.#state = { look, size, level };
    this.#start();
  }

  #start() {
    const canvas = document.createElement('canvas');
    this.#holder.replaceChildren(canvas);
    if (!canvas.transferControlToOffscreen) return this.#startHere(canvas);
    this.#worker = new Worker(new URL('./drawing_thread.mjs', import.meta.url), { type: 'module' });
    this.#worker.onmessage = ({ data }) => this.#hear(data);
    this.#worker.onerror = (event) => {
      event.preventDefault();
      this.#replace(event.message);
    };
    const offscreen = canvas.transferControlToOffscreen();
    this.#worker.postMessage({ type: 'begin', canvas: offscreen, ...this.#state }, [offscreen]);
  }

  async #startHere(canvas) {
    const { Drawer } = await import('./drawer.mjs');
    this.#drawer = new Drawer((message) => this.#hear(message));
    try {
      this.#drawer.hear({ type: 'begin', canvas, ...this.#state });
    } catch (error) {
      this.dispatchEvent(new CustomEvent('unable', { detail: { why: error.message } }));
    }
  }

  #replace(why = 'its worker died') {
    this.#endWatch();
    this.#worker.terminate();
    if (++this.#deaths > MOST_DEATHS) return this.dispatchEvent(new CustomEvent('unable', { detail: { why } }));
    this.isBusy = false;
    this.#endShots(null);
    this.#start();
    this.dispatchEvent(new CustomEvent('replaced'));
  }

  #hear({ type, ...data }) {
    if (type === 'alive') this.#endWatch = watchLife(data.lock, () => this.#replace());
    if (type === 'drawn') this.isBusy = false;
    if (type === 'drawn') this.#holder.classList.add('drawn');
    if (type === 'shot') this.#endShots(data.blob);
    this.dispatchEvent(new CustomEvent(type, { detail: data }));
  }

  #endShots(blob) {
    for (const tell of this.#shots.splice(0)) tell(blob);
  }

  #send(message, transfer = []) {
    if (this.#drawer) this.#drawer.hear(message);
    else this.#worker?.postMessage(message, transfer);
  }

  /** Draws a frame; the frame's arrays are gone then. */
  show(frame) {
    this.isBusy = true;
    const arrays = [...Object.values(frame.marks), ...Object.values(frame.surface ?? {})].filter(ArrayBuffer.isView);
    this.#send({ type: 'frame', frame }, arrays.map((array) => array.buffer));
  }

  setLook(look) {
    this.#state.look = look;
    this.#send({ type: 'look', look });
  }

  /** Width and height in pixels of the page, and how many of the screen's are in one. */
  resize(size) {
    this.#state.size = size;
    this.#send({ type: 'resize', size });
  }

  /** The picture as a PNG; null while its context is lost, or where its worker died. */
  shoot() {
    return new Promise((resolve) => {
      this.#shots.push(resolve);
      this.#send({ type: 'shot' });
    });
  }
}
