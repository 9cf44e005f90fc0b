// SPDX-License-Identifier: Apache-2.0
// A hand for those who use keys alone: where the picture has the focus, arrows move a cross and Space puts the tool on and off.
const STEP = 9, TURN = 40; // pixels
const WAYS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };

export class KeyHand {
  #x = 0;
  #y = 0;
  #isDown = false;

  constructor(place, cross, hands) {
    this.place = place;
    this.cross = cross;
    this.hands = hands;
    place.addEventListener('keydown', (event) => this.#hear(event));
    place.addEventListener('blur', () => this.#leave());
    place.addEventListener('pointerdown', () => this.#leave());
  }

  #hear(event) {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const way = WAYS[event.key], zoom = { '+': 1, '-': -1 }[event.key];
    if (way && event.shiftKey) this.#turn(way);
    else if (way) this.#move(way);
    else if (event.key === ' ') event.repeat || this.#press();
    else if (zoom) this.hands.put('wheel', ...this.#middle(), { wheel: zoom });
    else return;
    event.preventDefault();
    event.stopPropagation();
  }

  #middle() {
    return [this.place.clientWidth / 2, this.place.clientHeight / 2];
  }

  #enter() {
    if (!this.cross.hidden) return;
    [this.#x, this.#y] = this.#middle();
    this.cross.hidden = false;
  }

  #leave() {
    if (this.#isDown) this.#press();
    this.cross.hidden = true;
  }

  #move([x, y]) {
    this.#enter();
    this.#x = Math.min(Math.max(this.#x + STEP * x, 0), this.place.clientWidth);
    this.#y = Math.min(Math.max(this.#y + STEP * y, 0), this.place.clientHeight);
    this.cross.style.transform = `translate(${this.#x}px, ${this.#y}px)`;
    this.hands.put('move', this.#x, this.#y, {});
  }

  #press() {
    this.#enter();
    this.#isDown = !this.#isDown;
    this.cross.classList.toggle('down', this.#isDown);
    this.hands.put(this.#isDown ? 'press' : 'release', this.#x, this.#y, { button: 'left' });
  }

  /** The drag has been given up. */
  letGo() {
    this.#isDown = false;
    this.cross.classList.remove('down');
  }

  #turn([x, y]) {
    const [left, top] = this.#middle();
    this.hands.put('press', left, top, { button: 'right' });
    this.hands.put('move', left + TURN * x, top + TURN * y, {});
    this.hands.put('release', left + TURN * x, top + TURN * y, { button: 'right' });
  }
}
