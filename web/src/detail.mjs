// SPDX-License-Identifier: Apache-2.0
// How much is drawn: as much as the machine draws in time, and more of what stands still.

/** From the best: with the grain of tissue; without; and with fewer pixels as well. */
export const LEVELS = ['full', 'plain', 'coarse'];
const SLOW_MS = 30; // a picture that takes longer
const SLOW_PICTURES = 10; // of the last `OF_PICTURES`: less is drawn from then on
const OF_PICTURES = 14;

export class Detail {
  #isFixed;
  #times = [];

  /** @param wanted      one of `LEVELS` that is kept to, if any
   *  @param isSoftware  whether a processor draws, which has frames to compute as well */
  constructor(wanted, isSoftware) {
    this.#isFixed = Boolean(wanted);
    this.level = wanted ?? LEVELS[isSoftware ? 2 : 0];
  }

  /** Of a picture that nothing follows. */
  get still() {
    return this.#isFixed ? this.level : LEVELS[Math.max(0, LEVELS.indexOf(this.level) - 1)];
  }

  /** Hears how long a picture took. Returns whether less is to be drawn from now on. */
  judge(ms) {
    this.#times.push(ms);
    if (this.#times.length > OF_PICTURES) this.#times.shift();
    const next = LEVELS[LEVELS.indexOf(this.level) + 1];
    if (this.#isFixed || !next || this.#times.filter((each) => each > SLOW_MS).length < SLOW_PICTURES) return false;
    this.#times = [];
    this.level = next;
    return true;
  }
}
