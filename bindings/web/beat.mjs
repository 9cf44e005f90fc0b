// SPDX-License-Identifier: Apache-2.0
// When a session's frames come, by the clock.

const LATEST_MS = 50; // that frames make up for
const SHORTEST_MS = 2; // that a timer is set for: browsers make 4 ms of what is shorter, once timers follow each other

/** Acts as soon as the messages that have come are heard. */
function makeHop(act) {
  const { port1, port2 } = new MessageChannel();
  port1.onmessage = () => act();
  return () => port2.postMessage(null);
}

/** Frames keep the beat of the clock: a late one does not delay those after it, unless it was so late that they would be a rush. */
export class Beat {
  #due;

  /** @param act  one frame, at whose end `wait` is to be called; what follows is for tests */
  constructor(act, { hop = makeHop(act), timer = (ms) => setTimeout(act, ms), clock = () => performance.now() } = {}) {
    Object.assign(this, { hop, timer, clock });
  }

  /** Acts again this number of ms after this act was due. */
  wait(ms) {
    const now = this.clock();
    this.#due = Math.max((this.#due ?? now) + ms, now - LATEST_MS);
    const left = this.#due - now;
    if (left < SHORTEST_MS) this.hop();
    else this.timer(left);
  }
}
