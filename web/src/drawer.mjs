// SPDX-License-Identifier: Apache-2.0
// Takes what drawing.mjs sends, in a worker or in the page itself: one picture at a time, and as much in it as the machine draws in time.
import { LEVELS, Picture, contextOf } from './picture.mjs';

const SOFTWARE = /swiftshader|llvmpipe|softpipe|software|basic render/i; // processors that draw
const SLOW_MS = 30; // a picture that takes longer
const SLOW_PICTURES = 10; // of the last `OF_PICTURES`: less is drawn from then on
const OF_PICTURES = 14;

/** Who draws; '' where the browser does not tell. Asked before there is a picture: a context's samples are chosen when it is made. */
function rendererHere() {
  const context = contextOf(globalThis.OffscreenCanvas ? new OffscreenCanvas(1, 1) : document.createElement('canvas'), false);
  const names = context?.getExtension('WEBGL_debug_renderer_info');
  const renderer = names ? context.getParameter(names.UNMASKED_RENDERER_WEBGL) : '';
  context?.getExtension('WEBGL_lose_context')?.loseContext();
  return renderer;
}

export class Drawer {
  #tell;
  #picture;
  #canvas;
  #canFall = true;
  #times = [];
  #isDrawing = false;
  #isDue = false;

  constructor(tell) {
    this.#tell = tell;
  }

  hear({ type, ...data }) {
    const doings = { begin: this.#begin, frame: this.#take, look: this.#setLook, resize: this.#resize, shot: this.#shoot };
    if (type === 'begin' || this.#picture) doings[type].call(this, data);
  }

  /** For tests: the picture, whose context they lose. */
  get picture() {
    return this.#picture;
  }

  #begin({ canvas, look, size, level }) {
    this.#canvas = canvas;
    canvas.addEventListener('webglcontextlost', (event) => {
      event.preventDefault();
      this.#tell({ type: 'lost' });
    });
    canvas.addEventListener('webglcontextrestored', () => {
      this.#tell({ type: 'restored' });
      this.#ask();
    });
    const renderer = rendererHere(), isSoftware = SOFTWARE.test(renderer);
    const best = level ?? LEVELS[isSoftware ? 1 : 0];
    const context = contextOf(canvas, !isSoftware || best === 'full'); // four samples are most of what a processor has to do
    if (!context) return this.#tell({ type: 'unable' });
    this.#picture = new Picture(canvas, context, look);
    this.#canFall = !level;
    this.#picture.setLevel(best);
    this.#picture.resize(...size);
    this.#tell({ type: 'begun', renderer, isSoftware, level: this.#picture.level });
  }

  #take({ frame }) {
    this.#picture.take(frame);
    this.#ask();
  }

  #setLook({ look }) {
    this.#picture.setLook(look);
    this.#ask();
  }

  #resize({ size }) {
    this.#picture.resize(...size);
    this.#ask();
  }

  /** A picture of what is there, as soon as the last one is done. */
  #ask() {
    this.#isDue = true;
    if (!this.#isDrawing) this.#draw();
  }

  #draw() {
    this.#isDrawing = true;
    requestAnimationFrame(() => {
      this.#isDue = false;
      const began = performance.now(), context = this.#picture.renderer.getContext();
      if (context.isContextLost()) return this.#done(0);
      this.#picture.draw();
      const fence = context.fenceSync(context.SYNC_GPU_COMMANDS_COMPLETE, 0);
      context.flush();
      this.#await(context, fence, began);
    });
  }

  /** A picture is done when it is on the screen's side, not when it has been asked for. */
  #await(context, fence, began) {
    const status = fence && !context.isContextLost() ? context.clientWaitSync(fence, 0, 0) : context.ALREADY_SIGNALED;
    if (status === context.TIMEOUT_EXPIRED) return setTimeout(() => this.#await(context, fence, began));
    if (fence) context.deleteSync(fence);
    this.#done(performance.now() - began);
  }

  #done(ms) {
    this.#isDrawing = false;
    this.#judge(ms);
    this.#tell({ type: 'drawn', ms, hasBody: this.#picture.surface.visible });
    if (this.#isDue) this.#draw();
  }

  #judge(ms) {
    this.#times.push(ms);
    if (this.#times.length > OF_PICTURES) this.#times.shift();
    const next = LEVELS[LEVELS.indexOf(this.#picture.level) + 1];
    if (!this.#canFall || !next || this.#times.filter((each) => each > SLOW_MS).length < SLOW_PICTURES) return;
    this.#times = [];
    this.#picture.setLevel(next);
    this.#tell({ type: 'level', level: next });
  }

  async #shoot() {
    this.#picture.draw(); // what was drawn before may be gone
    const blob = this.#canvas.convertToBlob ? await this.#canvas.convertToBlob() : await new Promise((resolve) => this.#canvas.toBlob(resolve));
    this.#tell({ type: 'shot', blob });
  }
}
