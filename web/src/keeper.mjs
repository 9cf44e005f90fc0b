// SPDX-License-Identifier: Apache-2.0
// Keeps a session alive: where its worker dies another one goes on from the last recording, bit for bit.
import { SessionWorker } from 'incise/worker';

const SHORT_MS = 60_000; // deaths within this have to do with each other

function deferred() {
  const made = { isDone: false };
  made.promise = new Promise((resolve) => (made.end = () => resolve((made.isDone = true))));
  return made;
}

/**
 * Events: those of `SessionWorker`, but for `warm`, which comes once, and `broken`; `dead` {error} when a worker has died and another
 * one starts; `resumed` {info, isWhole} when that has what was kept, or the body afresh; `lost` {error} when no further one is tried.
 */
export class Keeper extends EventTarget {
  #opened = null;
  #kept = null; // a recording, and whether the body was at rest
  #dropped = null; // what was kept, and given up
  #choice = null; // what was asked for last
  #warm = deferred(); // until an engine answers at once
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

  /** Opens it, as soon as there is an engine. What it answers; nothing where something else was chosen meanwhile. */
  async open(what) {
    this.#choice = what;
    await this.#warm.promise;
    if (what !== this.#choice) return null;
    const engine = this.engine, info = await engine.ask('open', what);
    if (engine !== this.engine) return info; // it has died since
    this.#opened = what;
    this.#kept = this.#dropped = null;
    return info;
  }

  /** Recordings of what was done, as far as it was kept, given up or not; the older one first. */
  get saved() {
    return [this.#dropped, this.#kept].filter(Boolean).map(({ recording }) => recording);
  }

  /** Name to bytes, of what is open and what lies beside it. */
  get files() {
    const { files, bytes, name } = this.#opened ?? {};
    return name ? { ...files, [name]: bytes } : {};
  }

  async #begin() {
    const engine = this.engine;
    this.#wasWarm = true;
    if (!this.#opened) this.#tell('warm');
    else await this.#resume().catch((error) => this.#tell('failed', { error }));
    if (engine === this.engine) this.#warm.end();
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
    if (this.#deaths.length === 2) {
      this.#dropped = this.#kept ?? this.#dropped;
      this.#kept = null;
    }
    if (this.#warm.isDone) this.#warm = deferred();
    this.#tell('dead', { error });
    this.start();
  }
}
