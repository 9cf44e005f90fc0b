// SPDX-License-Identifier: Apache-2.0
// Requests that never queue up: while one waits for its answer, what comes is put together with the next.

/** Sends the newest value alone: those that come while one is under way replace each other. */
export function newest(send) {
  let isBusy = false, next = null;
  return async (value) => {
    next = { value };
    if (isBusy) return;
    isBusy = true;
    while (next) {
      const now = next;
      next = null;
      await send(now.value);
    }
    isBusy = false;
  };
}

/** Sends what `take` has gathered, one batch at a time, at most one for each picture of the screen. */
export function batches(take, send, atNextPicture) {
  let isBusy = false;
  const go = async () => {
    const batch = take();
    if (batch.length > 0) await send(batch);
    isBusy = false;
    if (batch.length > 0) poke(); // what came meanwhile
  };
  const poke = () => {
    if (isBusy) return;
    isBusy = true;
    atNextPicture(go);
  };
  return poke;
}

/** One act after the other; a key that is held down adds none while one is under way. */
export function inTurn() {
  let last = Promise.resolve(), count = 0;
  return (what, isRepeat = false) => {
    if (isRepeat && count > 0) return null;
    ++count;
    const result = last.then(what);
    last = result.catch(() => {}).finally(() => --count);
    return result;
  };
}

/**
 * Frames from who computes to who draws: at most one is drawn and one waits, and the next is wanted when that goes on. Where one
 * processor computes and draws none waits, and the next is wanted a while after a picture is done: it is of then, and frames were computed in between.
 */
export class Frames {
  #waiting = null;
  #later;
  /** From a picture to when the next frame is wanted; 0: it waits already. */
  restMs = 0;
  constructor(drawing, want, later = setTimeout) {
    this.drawing = drawing;
    this.want = want;
    this.#later = later;
  }
  take(frame) {
    this.#waiting = frame;
    this.#show();
  }
  /** To be called when drawing has become free, too. */
  pass() {
    if (!this.#show() && this.restMs > 0) this.#later.call(globalThis, () => this.want(), this.restMs);
  }
  #show() {
    if (!this.#waiting || this.drawing.isBusy) return false;
    const frame = this.#waiting;
    this.#waiting = null;
    this.drawing.show(frame);
    if (this.restMs === 0) this.want();
    return true;
  }
}
