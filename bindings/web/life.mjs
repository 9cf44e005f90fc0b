// SPDX-License-Identifier: Apache-2.0
// How a page learns that a worker is gone. A worker that is out of memory or was ended from outside says nothing; the lock that
// it held is then free, which the browser tells at once. Pages that are not served securely have no locks, and hear nothing.

/** In a worker: holds a lock as long as the worker lives. `tell` is given the lock's name once it is held. */
export function holdLife(tell) {
  const lock = `incise ${performance.timeOrigin} ${Math.random()}`;
  navigator.locks?.request(lock, () => {
    tell(lock);
    return new Promise(() => {});
  });
}

/** In the page: calls `died` when whoever holds the lock is gone. Returns what ends the watch. */
export function watchLife(lock, died) {
  const watch = new AbortController();
  navigator.locks.request(lock, { signal: watch.signal }, died).catch(() => {}); // ended
  return () => watch.abort();
}
