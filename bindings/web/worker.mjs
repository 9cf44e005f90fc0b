// SPDX-License-Identifier: Apache-2.0
// A session in a worker: questions with answers, pointer events, frames. `import { SessionWorker } from 'incise/worker'`;
// what may be asked and what is told: worker.d.mts.
export class SessionWorker extends EventTarget {
  #worker;
  #waiting = new Map();
  #next = 1;

  constructor() {
    super();
    this.#worker = new Worker(new URL('./worker_thread.mjs', import.meta.url), { type: 'module' });
    this.#worker.onmessage = ({ data }) => this.#hear(data);
    this.#worker.onerror = (event) => {
      event.preventDefault();
      this.#tell('broken', { error: { message: event.message || 'the worker ended', code: 'Internal' } });
    };
  }

  #tell(type, data) {
    this.dispatchEvent(new CustomEvent(type, { detail: data }));
  }

  #hear(data) {
    if (data.type !== 'answer') return this.#tell(data.type, data);
    const { resolve, reject } = this.#waiting.get(data.id);
    this.#waiting.delete(data.id);
    if (data.error) reject(Object.assign(new Error(data.error.message), { code: data.error.code }));
    else resolve(data.value);
  }

  ask(what, arguments_) {
    return new Promise((resolve, reject) => {
      const id = this.#next++;
      this.#waiting.set(id, { resolve, reject });
      this.#worker.postMessage({ type: 'ask', id, what, with: arguments_ });
    });
  }

  send(message) {
    this.#worker.postMessage(message);
  }

  /** Ends the worker. What waits for an answer is told so. */
  end() {
    this.#worker.terminate();
    for (const { reject } of this.#waiting.values()) reject(new Error('the worker was ended'));
    this.#waiting.clear();
  }
}
