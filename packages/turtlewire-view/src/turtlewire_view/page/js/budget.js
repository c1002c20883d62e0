// The number of points that the page can draw, from the time per picture; sent to the server.

const SLOW_MS = 40;
const FAST_MS = 22;
const START = { software: 40_000, hardware: 1_000_000 };
const LIMITS = [5_000, 4_000_000];
const PICTURES = 20; // between two decisions

export class Budget {
  /** Points of all displays together. */
  points;
  #send;
  #times = [];

  constructor(isSoftware, send) {
    this.points = isSoftware ? START.software : START.hardware;
    this.#send = send;
  }

  /** Tell it (again). */
  announce() {
    this.#send({ type: "budget", points: this.points });
  }

  /** A picture with displays in it took `milliseconds`, until the browser was ready for another. */
  take(milliseconds) {
    this.#times.push(milliseconds);
    if (this.#times.length < PICTURES) return;
    const middle = this.#times.sort((a, b) => a - b)[PICTURES / 2];
    this.#times = [];
    const factor = middle > SLOW_MS ? 0.7 : middle < FAST_MS ? 1.25 : 1;
    const points = Math.round(Math.min(LIMITS[1], Math.max(LIMITS[0], this.points * factor)));
    if (points === this.points) return;
    this.points = points;
    this.announce();
  }
}
