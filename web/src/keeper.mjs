// SPDX-License-Identifier: Apache-2.0
// Keeps a session alive: where its worker dies another one goes on from the last recording, bit for bit.
import { SessionWorker } from 'incise/worker';

const SHORT_MS = 60_000; // deaths within this have to do with each other

/**
 * Events: those of `SessionWorker`, but for `warm`, which comes once, and `broken`; `dead` {error} when a worker has died and another
 * one starts; `resumed` {info, isWhole} when that has what was kept, or the body afresh; `lost` {error} when no further one is tried.
 */
export class Keeper extends EventTarget {
  #opened = null;
  #kept = null; // a recording, and whether the body was at rest
  #deaths = [];
  #wasWarm = false;
  engine = null;

  start() {
    const engine = (this.engine = new SessionWorker());
    for (const type of ['loaded', 'frame', 'replayed', 'failed']) engine.addEventListener(type, ({ detail }) => this.#tell(type, detail));
    engine.addEventListener('kept', ({ detail }) => (this.#kept = detail));
    engine.addEventListener('warm', () => this.#begin());
    engine.addEventListener('broken', ({ detail }) => this.#mourn(detail.error));
  }

  #tell(type, detail) {
    this.dispatchEvent(new CustomEvent(type, { detail }));
  }

  async open(what) {
    const engine = this.engine, info = await engine.ask('open', what);
    if (engine !== this.engine) return info; // it has died since
    this.#opened = what;
    this.#kept = null;
    return info;
  }

  /** Name to bytes, of what is open and what lies beside it. */
  get files() {
    const { files, bytes, name } = this.#opened ?? {};
    return name ? { ...files, [name]: bytes } : {};
  }

  #begin() {
    this.#wasWarm = true;
    if (!this.#opened) return this.#tell('warm');
    this.#resume().catch((error) => this.#tell('failed', { error }));
  }

  async #resume() {
    const { files, bytes, name, up } = this.#opened, kept = this.#kept;
    let keptName = 'kept.jsonl';
    while (keptName === name || files?.[keptName]) keptName = `again-${keptName}`; // what was opened may have this name
    const end = kept && { bytes: kept.recording, name: keptName, files: { ...files, [name]: bytes }, up, resumes: true, isAtRest: kept.isAtRest };
    const info = await this.engine.ask('open', end ?? this.#opened);
    this.#tell('resumed', { info, isWhole: kept !== null });
  }

  /** The second death in a short time may come of what was kept, a third one of the body. */
  #mourn(error) {
    const now = performance.now();
    this.#deaths = [...this.#deaths.filter((then) => now - then < SHORT_MS), now];
    if (!this.#wasWarm || this.#deaths.length > 2) return this.#tell('lost', { error });
    if (this.#deaths.length === 2) this.#kept = null;
    this.#tell('dead', { error });
    this.start();
  }
}
