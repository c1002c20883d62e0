// Mouse, pen and finger on the field: choose a turtle, drag one elsewhere, or place a new one.

const REACH_METRES = 0.55;
const DRAG_METRES = 0.25;

export class Pointer {
  #field;
  #actions;
  #start = null;
  #grabbed = null;
  #placing = false;
  /** The turtle in the user's hand, for Field.drawTurtles, or null. */
  ghost = null;

  /**
   * `actions`: turtles() returns [{ name, x, y, theta }]; choose(name), move(name, place),
   * spawn(place), placingChanged(on).
   */
  constructor(field, actions) {
    this.#field = field;
    this.#actions = actions;
    const canvas = field.canvas;
    canvas.addEventListener("pointerdown", (event) => this.#down(event));
    canvas.addEventListener("pointermove", (event) => this.#move(event));
    canvas.addEventListener("pointerup", (event) => this.#up(event));
    canvas.addEventListener("pointercancel", () => this.#drop());
    addEventListener("keydown", ({ key }) => key === "Escape" && this.setPlacing(false));
  }

  get placing() {
    return this.#placing;
  }

  /** The next press on the field is the place of a new turtle; dragging gives its heading. */
  setPlacing(on) {
    this.#placing = on;
    this.#drop();
    this.#actions.placingChanged(on);
  }

  #down(event) {
    if (event.button !== 0) return;
    this.#start = this.#field.placeOf(event);
    this.#grabbed = this.#placing ? null : this.#nearest(this.#start);
    if (this.#placing) this.ghost = { name: "", ...this.#start, theta: 0 };
    if (this.#placing || this.#grabbed) {
      this.#field.canvas.setPointerCapture(event.pointerId);
      event.preventDefault();
    }
  }

  #move(event) {
    const place = this.#field.placeOf(event);
    if (!this.#start) {
      const overTurtle = !this.#placing && this.#nearest(place);
      this.#field.canvas.style.cursor = this.#placing ? "crosshair" : overTurtle ? "grab" : "";
      return;
    }
    const [dx, dy] = [place.x - this.#start.x, place.y - this.#start.y];
    if (Math.hypot(dx, dy) < DRAG_METRES) return;
    if (this.#placing) this.ghost = { ...this.ghost, theta: Math.atan2(dy, dx) };
    else if (this.#grabbed) {
      const { name, theta } = this.#grabbed;
      this.ghost = { name, ...place, theta };
    }
  }

  #up() {
    const { ghost } = this;
    const grabbed = this.#grabbed;
    const placed = this.#placing && this.#start;
    this.#drop();
    if (placed) {
      this.setPlacing(false);
      this.#actions.spawn(ghost);
    } else if (grabbed && ghost) this.#actions.move(grabbed.name, ghost);
    else if (grabbed) this.#actions.choose(grabbed.name);
  }

  #drop() {
    this.#start = this.#grabbed = this.ghost = null;
  }

  #nearest({ x, y }) {
    let [best, distance] = [null, REACH_METRES];
    for (const turtle of this.#actions.turtles()) {
      const away = Math.hypot(turtle.x - x, turtle.y - y);
      if (away < distance) [best, distance] = [turtle, away];
    }
    return best;
  }
}
