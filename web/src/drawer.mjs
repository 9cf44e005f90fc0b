// SPDX-License-Identifier: Apache-2.0
// Takes what drawing.mjs sends, in a worker or in the page itself: one picture at a time, and as much in it as the machine draws in time.
import { Detail } from './detail.mjs';
import { Picture, contextOf } from './picture.mjs';

const SOFTWARE = /swiftshader|llvmpipe|softpipe|software|basic render/i; // processors that draw
const STILL_MS = 250; // after a picture that nothing follows it is drawn with more detail

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
  #detail;
  #isDrawing = false;
  #isDue = false;
  #stillTimer = 0;

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
    const context = contextOf(canvas, !isSoftware || level === 'full'); // four samples are most of what a processor has to do
    if (!context) return this.#tell({ type: 'unable' });
    this.#picture = new Picture(canvas, context, look);
    this.#detail = new Detail(level, isSoftware);
    this.#picture.setLevel(this.#detail.level);
    this.#picture.resize(...size);
    this.#tell({ type: 'begun', renderer, isSoftware, level: this.#detail.level }); // `isSoftware`: see `Frames.restMs`
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
    clearTimeout(this.#stillTimer);
    this.#isDue = true;
    if (!this.#isDrawing) this.#draw(false);
  }

  #draw(isStill) {
    this.#isDrawing = true;
    requestAnimationFrame(() => {
      if (!isStill) this.#isDue = false;
      const began = performance.now(), context = this.#picture.renderer.getContext();
      if (context.isContextLost()) return this.#done(0, isStill);
      this.#drawAt(isStill ? this.#detail.still : this.#detail.level);
      const fence = context.fenceSync(context.SYNC_GPU_COMMANDS_COMPLETE, 0);
      context.flush();
      this.#await(context, fence, began, isStill);
    });
  }

  #drawAt(level) {
    if (this.#picture.level !== level) this.#picture.setLevel(level);
    this.#picture.draw();
  }

  /** A picture is done when it is on the screen's side, not when it has been asked for. */
  #await(context, fence, began, isStill) {
    const status = fence && !context.isContextLost() ? context.clientWaitSync(fence, 0, 0) : context.ALREADY_SIGNALED;
    if (status === context.TIMEOUT_EXPIRED) return setTimeout(() => this.#await(context, fence, began, isStill));
    if (fence) context.deleteSync(fence);
    this.#done(performance.now() - began, isStill);
  }

  #done(ms, isStill) {
    this.#isDrawing = false;
    if (!isStill && this.#detail.judge(ms)) this.#tell({ type: 'level', level: this.#detail.level });
    this.#tell({ type: 'drawn', ms, hasBody: this.#picture.surface.visible });
    if (this.#isDue) this.#draw(false);
    else if (!isStill && this.#detail.still !== this.#detail.level) this.#stillTimer = setTimeout(() => this.#draw(true), STILL_MS);
  }

  async #shoot() {
    if (this.#picture.renderer.getContext().isContextLost()) return this.#tell({ type: 'shot', blob: null });
    this.#drawAt(this.#detail.still); // what was drawn before may be gone
    const blob = this.#canvas.convertToBlob ? await this.#canvas.convertToBlob() : await new Promise((resolve) => this.#canvas.toBlob(resolve));
    this.#tell({ type: 'shot', blob });
  }
}
