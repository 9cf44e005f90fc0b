// SPDX-License-Identifier: Apache-2.0
// Cuts of a small cube that nobody sees, so that engines compile what cutting takes before a person cuts: first in haste, then,
// where much of it has run, in full.

const STROKE = 25; // frames

/** A cube of some cells a side in a session of its own, which is cut for some frames; every stroke is taken back. */
export class Practice {
  #session;
  #left;
  #step = 0;

  constructor(Session, cells, frames) {
    const scene = {
      format: 'incise-scene', version: 1, length_unit: 0.1, gravity: [0, 0, 0], contact: { self: true },
      model: { box: { cells: [cells, cells, cells], size: [1, 1, 1] } },
    };
    this.#session = Session.open(JSON.stringify(scene), 'practice.json');
    this.#session.resize(100, 100);
    this.#session.refresh();
    this.#left = frames;
  }

  get isOver() {
    return this.#left === 0;
  }

  /** One frame. */
  goOn() {
    const session = this.#session, at = this.#step++ % STROKE;
    if (at === 0) session.pointer('press', 25, 40);
    session.pointer('move', 25 + 2 * at, 40 + 0.3 * at);
    session.frame();
    session.refresh();
    --this.#left;
    if (at === STROKE - 1 || this.isOver) this.#takeBack();
    if (this.isOver) this.end();
  }

  #takeBack() {
    this.#session.pointer('release', 75, 48);
    this.#session.frame();
    this.#session.undo();
    this.#session.refresh();
  }

  end() {
    this.#left = 0;
    this.#session.dispose();
  }
}
