// What part of the picture is seen: moved by pointers, the wheel and keys.

const CLOSEST = 2.5; // pixels of the screen for one of the picture
const FIT_CLOSEST = 1.25;
const READABLE = 0.85;
const START = 0.6; // on a narrow screen, which starts with a part that can be read
const NARROW_PX = 600;
const MOST_SCREENS = 5;
const WHEEL = 0.0016;
const STEP = 60;
const ZOOM_STEP = 1.25;
const CLICK_PX = 4; // a hand trembles

export class Camera {
  #svg;
  #size = { width: 1, height: 1 };
  #centre = { x: 0, y: 0 };
  #scale = 1;
  #mode = "start"; // then "whole" or "moved"
  #pointers = new Map();
  #moved = 0;
  #onScale;

  /** `onScale(scale)` is told when the picture becomes larger or smaller. */
  constructor(svg, onScale) {
    this.#svg = svg;
    this.#onScale = onScale;
    new ResizeObserver(() => this.#look()).observe(svg);
    svg.addEventListener("wheel", (event) => this.#wheel(event), { passive: false });
    svg.addEventListener("pointerdown", (event) => this.#down(event));
    svg.addEventListener("pointermove", (event) => this.#move(event));
    for (const type of ["pointerup", "pointercancel"]) {
      svg.addEventListener(type, ({ pointerId }) => this.#pointers.delete(pointerId));
    }
    svg.addEventListener("keydown", (event) => this.#key(event));
  }

  /** Whether the last press moved the picture, so that it selects nothing. */
  get hasDragged() {
    return this.#moved > CLICK_PX;
  }

  /** Another picture; a camera that the user has moved stays. */
  take({ width, height }) {
    this.#size = { width, height };
    this.#look();
  }

  /** Show everything, until the user moves the picture. */
  fit() {
    this.#mode = "whole";
    this.#look();
  }

  /** Move a box into the picture, as large as it can be read. */
  reveal({ x, y, width, height }) {
    const view = this.#view();
    const half = { x: view.width / this.#scale / 2, y: view.height / this.#scale / 2 };
    const isInside = Math.abs(x + width / 2 - this.#centre.x) + width / 2 < half.x
      && Math.abs(y + height / 2 - this.#centre.y) + height / 2 < half.y;
    if (isInside && this.#scale >= READABLE / 2) return;
    this.#scale = Math.max(this.#scale, READABLE);
    this.#centre = { x: x + width / 2, y: y + height / 2 };
    this.#touch();
  }

  #view() {
    const { clientWidth, clientHeight } = this.#svg;
    return { width: clientWidth || 1, height: clientHeight || 1 };
  }

  #look() {
    if (this.#mode === "moved") return this.#apply();
    const view = this.#view();
    const scale = this.#fitting(view);
    this.#scale = scale;
    this.#centre = { x: this.#size.width / 2, y: this.#size.height / 2 };
    const isFew = this.#size.width * START < MOST_SCREENS * view.width;
    if (this.#mode === "start" && view.width < NARROW_PX && scale < START && isFew) {
      this.#scale = START;
      this.#centre.x = view.width / START / 2;
    }
    this.#apply();
  }

  /** The scale that shows everything. */
  #fitting({ width, height }) {
    const { width: whole, height: high } = this.#size;
    return Math.min(FIT_CLOSEST, width / (whole || 1), height / (high || 1));
  }

  #touch() {
    this.#mode = "moved";
    this.#apply();
  }

  #apply() {
    const view = this.#view();
    this.#scale = Math.min(Math.max(this.#scale, this.#fitting(view) / 1.5), CLOSEST);
    this.#centre.x = Math.min(Math.max(this.#centre.x, 0), this.#size.width);
    this.#centre.y = Math.min(Math.max(this.#centre.y, 0), this.#size.height);
    const width = view.width / this.#scale;
    const height = view.height / this.#scale;
    const corner = [this.#centre.x - width / 2, this.#centre.y - height / 2];
    this.#svg.setAttribute("viewBox", [...corner, width, height].join(" "));
    this.#onScale(this.#scale);
  }

  /** Zoom and keep what is at a point of the screen there. */
  #zoom(factor, clientX, clientY) {
    const box = this.#svg.getBoundingClientRect();
    const away = { x: clientX - box.x - box.width / 2, y: clientY - box.y - box.height / 2 };
    const before = this.#scale;
    this.#scale = Math.min(before * factor, CLOSEST);
    this.#centre.x += away.x / before - away.x / this.#scale;
    this.#centre.y += away.y / before - away.y / this.#scale;
    this.#touch();
  }

  #wheel(event) {
    event.preventDefault();
    const pixels = event.deltaY * (event.deltaMode === 1 ? 30 : 1);
    this.#zoom(Math.exp(-WHEEL * pixels), event.clientX, event.clientY);
  }

  #down(event) {
    if (event.button !== 0) return;
    if (!this.#pointers.size) this.#moved = 0;
    this.#pointers.set(event.pointerId, [event.clientX, event.clientY]);
  }

  #move(event) {
    const before = this.#pointers.get(event.pointerId);
    if (!before) return;
    const now = [event.clientX, event.clientY];
    const step = now.map((value, k) => value - before[k]);
    this.#moved += Math.hypot(...step);
    this.#pointers.set(event.pointerId, now);
    if (!this.hasDragged) return;
    this.#svg.setPointerCapture(event.pointerId);
    const other = [...this.#pointers].find(([id]) => id !== event.pointerId)?.[1];
    if (other) {
      const distance = (point) => Math.hypot(point[0] - other[0], point[1] - other[1]) || 1;
      const middle = now.map((value, k) => (value + other[k]) / 2);
      this.#zoom(distance(now) / distance(before), ...middle);
    }
    const share = other ? 0.5 : 1;
    this.#centre.x -= (share * step[0]) / this.#scale;
    this.#centre.y -= (share * step[1]) / this.#scale;
    this.#touch();
  }

  #key(event) {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    const steps = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
    const zooms = { "+": ZOOM_STEP, "=": ZOOM_STEP, "-": 1 / ZOOM_STEP };
    const step = steps[event.key];
    if (step) {
      this.#centre.x += (STEP * step[0]) / this.#scale;
      this.#centre.y += (STEP * step[1]) / this.#scale;
      this.#touch();
    } else if (zooms[event.key]) {
      const { x, y, width, height } = this.#svg.getBoundingClientRect();
      this.#zoom(zooms[event.key], x + width / 2, y + height / 2);
    } else return;
    event.preventDefault();
  }
}
