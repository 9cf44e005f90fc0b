// SPDX-License-Identifier: Apache-2.0
// Mouse, touch and pen to the pointer events of the tools. Two fingers turn, move and zoom the view.
const BUTTONS = ['left', 'middle', 'right'];
const PINCH_NOTCH = 1.1; // of spread per notch of a wheel
const NOTCH = 100, LINE = 33; // pixels that a browser scrolls by a notch of a wheel, and by a line

export class Hands {
  #fingers = new Map();
  #gesture = null;
  #events = [];
  #down = null; // the button of a drag
  #pointer = null; // whose it is
  #tell;

  /** @param tell  that there is something to take */
  constructor(place, tell) {
    this.place = place;
    this.#tell = tell;
    const hear = (type, what, options) => place.addEventListener(type, what, options);
    hear('pointerdown', (event) => this.#press(event));
    hear('pointermove', (event) => this.#move(event));
    hear('pointerup', (event) => this.#release(event));
    hear('pointercancel', (event) => this.#release(event));
    hear('contextmenu', (event) => event.preventDefault());
    hear('wheel', (event) => this.#wheel(event), { passive: false });
  }

  take() {
    return this.#events.splice(0);
  }

  /** An event at a place of the picture. */
  put(kind, x, y, options) {
    this.#events.push([kind, x, y, options]);
    this.#tell();
  }

  #add(kind, event, options = {}) {
    const { left, top } = this.place.getBoundingClientRect();
    const keys = { shift: event.shiftKey, control: event.ctrlKey, alt: event.altKey };
    const pressure = event.pointerType === 'pen' ? event.pressure : 1;
    this.put(kind, event.clientX - left, event.clientY - top, { ...keys, pressure, ...options });
  }

  #press(event) {
    const isTouch = event.pointerType === 'touch';
    // One hand at a time: no pen while two fingers turn the view, no palm while a pen is down.
    if (this.#fingers.size > 0 ? !isTouch : (this.#pointer ?? event.pointerId) !== event.pointerId) return;
    this.place.setPointerCapture(event.pointerId);
    if (isTouch) {
      this.#fingers.set(event.pointerId, event);
      if (this.#fingers.size === 2) return this.#beginGesture(event);
      if (this.#fingers.size > 2) return;
    }
    this.#down = BUTTONS[event.button] ?? 'left';
    this.#pointer = event.pointerId;
    this.#add('press', event, { button: this.#down });
  }

  #move(event) {
    if (this.#fingers.has(event.pointerId)) this.#fingers.set(event.pointerId, event);
    if (this.#gesture) return this.#goOn(event);
    if (this.#pointer !== null && this.#pointer !== event.pointerId) return;
    // Places between two frames count: a fast stroke is a curve and no chord.
    const all = this.#down === 'left' ? event.getCoalescedEvents?.() ?? [] : [];
    for (const each of all.length > 0 ? all : [event]) this.#add('move', each);
  }

  #release(event) {
    const wasFinger = this.#fingers.delete(event.pointerId);
    if (this.#gesture) {
      if (!wasFinger || this.#fingers.size > 0) return;
      this.#add('release', event, { button: 'right', ...this.#gesture.keys });
      this.#gesture = null;
      return;
    }
    if (event.pointerId !== this.#pointer) return;
    this.#add('release', event, { button: this.#down });
    this.#down = this.#pointer = null;
  }

  /** The second finger makes a look of what began as a stroke. */
  #beginGesture(event) {
    if (this.#down ?? this.#gesture) this.#add('release', event, { button: this.#down ?? 'right' });
    this.#down = this.#pointer = null;
    const { x, y, spread } = this.#middle();
    this.#gesture = { spread };
    this.#add('press', { ...keysOf(event), clientX: x, clientY: y }, { button: 'right' });
  }

  #goOn(event) {
    if (this.#fingers.size < 2) return;
    const { x, y, spread } = this.#middle();
    const place = { ...keysOf(event), clientX: x, clientY: y };
    this.#add('move', place);
    const notches = Math.log(spread / this.#gesture.spread) / Math.log(PINCH_NOTCH);
    if (Math.abs(notches) > 0.05) {
      this.#add('wheel', place, { wheel: notches });
      this.#gesture.spread = spread;
    }
  }

  #middle() {
    const [a, b] = [...this.#fingers.values()];
    const x = (a.clientX + b.clientX) / 2, y = (a.clientY + b.clientY) / 2;
    return { x, y, spread: Math.max(1, Math.hypot(a.clientX - b.clientX, a.clientY - b.clientY)) };
  }

  #wheel(event) {
    event.preventDefault();
    const pixels = (event.deltaY || event.deltaX) * (event.deltaMode ? LINE : 1); // with Shift some turn it sideways
    if (pixels !== 0) this.#add('wheel', event, { wheel: -Math.min(Math.max(pixels / NOTCH, -1), 1) });
  }
}

const keysOf = (event) => ({ shiftKey: event.shiftKey, ctrlKey: event.ctrlKey, altKey: event.altKey });
