// SPDX-License-Identifier: Apache-2.0
// Mouse, touch and pen to the pointer events of the tools. Two fingers turn, move and zoom the view.
const BUTTONS = ['left', 'middle', 'right'];
const PINCH_NOTCH = 1.1; // of spread per notch of a wheel

export class Hands {
  #fingers = new Map();
  #gesture = null;
  #events = [];
  #down = null; // the button of a drag
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
    this.place.setPointerCapture(event.pointerId);
    if (event.pointerType === 'touch') {
      this.#fingers.set(event.pointerId, event);
      if (this.#fingers.size === 2) return this.#beginGesture(event);
      if (this.#fingers.size > 2) return;
    }
    this.#down = BUTTONS[event.button] ?? 'left';
    this.#add('press', event, { button: this.#down });
  }

  #move(event) {
    if (this.#fingers.has(event.pointerId)) this.#fingers.set(event.pointerId, event);
    if (this.#gesture) return this.#goOn(event);
    if (this.#fingers.size > 0 && !this.#fingers.has(event.pointerId)) return;
    // Places between two frames count: a fast stroke is a curve and no chord.
    const all = this.#down === 'left' ? event.getCoalescedEvents?.() ?? [] : [];
    for (const each of all.length > 0 ? all : [event]) this.#add('move', each);
  }

  #release(event) {
    const wasFinger = this.#fingers.delete(event.pointerId);
    if (this.#gesture) {
      if (this.#fingers.size > 0) return;
      this.#add('release', event, { button: 'right', ...this.#gesture.keys });
      this.#gesture = null;
      return;
    }
    if (event.pointerType === 'touch' && !wasFinger) return;
    this.#add('release', event, { button: this.#down ?? 'left' });
    this.#down = null;
  }

  /** The second finger makes a look of what began as a stroke. */
  #beginGesture(event) {
    this.#add('release', event, { button: this.#down ?? 'left' });
    this.#down = null;
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
    this.#add('wheel', event, { wheel: -Math.sign(event.deltaY) });
  }
}

const keysOf = (event) => ({ shiftKey: event.shiftKey, ctrlKey: event.ctrlKey, altKey: event.altKey });
