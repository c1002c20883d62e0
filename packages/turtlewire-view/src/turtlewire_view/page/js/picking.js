// Frames under the pointer: hovered ones get their name, pressed ones are selected.

import { Vector3 } from "three";

const REACH = { mouse: 14, pen: 16, touch: 26 }; // [CSS pixels]
const DRAG = 5;

export class Picking {
  /** Index of the frame under the pointer, or -1. */
  hovered = -1;
  #view;
  #frames;
  #actions;
  #start = null;

  /** `actions`: select(index or -1, event), hover(index). */
  constructor(view, frames, actions) {
    this.#view = view;
    this.#frames = frames;
    this.#actions = actions;
    const { canvas } = view;
    canvas.addEventListener("pointermove", (event) => this.#move(event));
    canvas.addEventListener("pointerleave", () => this.#hover(-1));
    canvas.addEventListener("pointerdown", (event) => {
      this.#start = event.isPrimary && event.button === 0 ? event : null;
    });
    canvas.addEventListener("pointerup", (event) => this.#up(event));
  }

  /** The shown frame nearest to a place on the canvas, or -1. */
  nearest(x, y, reach) {
    const point = new Vector3();
    let [best, cost] = [-1, Infinity];
    for (let k = 0; k < this.#frames.count; k += 1) {
      if (!this.#frames.isShown(k)) continue;
      const at = this.#view.project(point.set(...this.#frames.position(k)));
      const away = at ? Math.hypot(at.x - x, at.y - y) : Infinity;
      if (away > reach) continue;
      if (away + at.depth < cost) [best, cost] = [k, away + at.depth];
    }
    return best;
  }

  #move(event) {
    if (!event.buttons) this.#hover(this.#under(event));
  }

  #hover(k) {
    if (k === this.hovered) return;
    this.hovered = k;
    this.#view.canvas.style.cursor = k >= 0 ? "pointer" : "";
    this.#actions.hover(k);
  }

  #up(event) {
    const start = this.#start;
    this.#start = null;
    if (!start || start.pointerId !== event.pointerId) return;
    if (Math.hypot(event.offsetX - start.offsetX, event.offsetY - start.offsetY) > DRAG) return;
    this.#actions.select(this.#under(event), event);
  }

  #under({ offsetX, offsetY, pointerType }) {
    return this.nearest(offsetX, offsetY, REACH[pointerType] ?? REACH.mouse);
  }
}
