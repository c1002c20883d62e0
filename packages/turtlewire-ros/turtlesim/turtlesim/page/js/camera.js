// Which part of the field is seen: all of it, or the surroundings of one turtle.

const FOLLOW_ZOOM = 2.5;
const SETTLE_PER_MS = 0.006;

/**
 * Works in canvas pixels: the field's picture has the side `size * zoom`, its corner is at `-left`,
 * `-top`.
 */
export class Camera {
  zoom = 1;
  left = 0;
  top = 0;
  #lastTime = null;
  #still = matchMedia("(prefers-reduced-motion: reduce)");

  get follows() {
    return this.zoom !== 1;
  }

  /** Follow, or show everything. */
  setFollow(follow) {
    this.zoom = follow ? FOLLOW_ZOOM : 1;
    this.#lastTime = null;
  }

  /** Move towards a turtle at `x`, `y`, in pixels of the whole field on a canvas of side `size`. */
  look(x, y, size, now) {
    const range = size * (this.zoom - 1);
    const aim = (at) => Math.min(range, Math.max(0, at * this.zoom - size / 2));
    const jump = this.#lastTime === null || this.#still.matches;
    const step = jump ? 1 : 1 - Math.exp(-SETTLE_PER_MS * (now - this.#lastTime));
    this.left += step * (aim(x) - this.left);
    this.top += step * (aim(y) - this.top);
    this.#lastTime = now;
  }

  /** Show the upper left corner, as when no turtle is followed. */
  rest() {
    this.left = this.top = 0;
    this.#lastTime = null;
  }
}
