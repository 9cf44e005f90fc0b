// SPDX-License-Identifier: Apache-2.0
// A session in a worker: questions with answers, pointer events, frames. `import { SessionWorker } from 'incise/worker'`;
// what may be asked and what is told: worker.d.mts.
import { watchLife } from './life.mjs';

const ended = () => Object.assign(new Error('the worker was ended'), { code: 'Ended' });

export class SessionWorker extends EventTarget {
  #worker;
  #waiting = new Map();
  #next = 1;
  #endWatch = () => {};
  #isEnded = false;

  constructor() {
    super();
    this.#worker = new Worker(new URL('./worker_thread.mjs', import.meta.url), { type: 'module' });
    this.#worker.onmessage = ({ data }) => this.#hear(data);
    this.#worker.onerror = (event) => {
      event.preventDefault();
      this.#break(event.message || 'the worker ended');
    };
  }

  /** Questions that wait for their answers. */
  get waiting() {
    return this.#waiting.size;
  }

  #break(message, code = 'Internal') {
    if (this.#isEnded) return; // its lock may have come free before the watch of it ended
    this.end();
    this.#tell('broken', { error: { message, code } });
  }

  #tell(type, data) {
    this.dispatchEvent(new CustomEvent(type, { detail: data }));
  }

  #hear(data) {
    if (data.type === 'alive') this.#endWatch = watchLife(data.lock, () => this.#break('the worker is gone'));
    else if (data.type === 'broken') this.#break(data.error.message, data.error.code);
    else if (data.type !== 'answer') return this.#tell(data.type, data);
    if (data.type !== 'answer' || !this.#waiting.has(data.id)) return;
    const { resolve, reject } = this.#waiting.get(data.id);
    this.#waiting.delete(data.id);
    if (data.error) reject(Object.assign(new Error(data.error.message), { code: data.error.code }));
    else resolve(data.value);
  }

  ask(what, arguments_) {
    return new Promise((resolve, reject) => {
      if (this.#isEnded) return reject(ended());
      const id = this.#next++;
      this.#worker.postMessage({ type: 'ask', id, what, with: arguments_ }); // throws where something cannot be sent
      this.#waiting.set(id, { resolve, reject });
    });
  }

  send(message) {
    this.#worker.postMessage(message);
  }

  /** Ends the worker. What waits for an answer is told so. */
  end() {
    this.#isEnded = true;
    this.#endWatch();
    this.#worker.onmessage = this.#worker.onerror = null;
    this.#worker.terminate();
    for (const { reject } of this.#waiting.values()) reject(ended());
    this.#waiting.clear();
  }
}
