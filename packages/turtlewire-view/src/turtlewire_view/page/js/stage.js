// The frames in the picture: drawing, names, trails, cameras and pointer work together here.
// Frames under the pointer: hovered ones get their name, pressed ones are selected.

import { Vector3 } from "three";

import { Cameras } from "./cameras.js";
import { cellFor, crowdOf, extentOf, sizeFor } from "./extent.js";
import { FrameDrawing } from "./frame_drawing.js";
import { Labels } from "./labels.js";
import { Trails } from "./trails.js";

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

const FADING_MS = 150;
const KEEP_MS = 100; // between two looks whether the frames are still in view
const SETTLE_MS = 300; // names are chosen again when a movement has ended

export class Stage {
  view;
  cameras;
  trails = new Trails();
  labels;
  drawing;
  #frames;
  #picking;
  #path = [];
  #selection = { source: -1, target: -1 };
  #isDirty = true;
  #settling = null;
  #fading = null;
  #fitted = -1;
  #seen = null; // middle and radius that the cameras look at by themselves
  #lookedAt = 0;
  #fixed = "";
  #sizeIsChosen = false;
  #onLook;

  /** `actions`: select(index, event), hover(index), look() after a change of camera or sizes. */
  constructor(view, frames, actions) {
    this.view = view;
    this.#frames = frames;
    this.#onLook = actions.look;
    this.drawing = new FrameDrawing(view.colors);
    this.labels = new Labels(view);
    this.cameras = new Cameras(view, actions.look);
    this.#picking = new Picking(view, frames, {
      select: actions.select,
      hover: (k) => {
        actions.hover(k);
        this.hover(k);
      },
    });
    view.resized.push(() => this.takeDisplay());
    view.scene.add(this.drawing.object, this.trails.object, this.labels.object);
    view.aids.frames.push(this.drawing.object, this.trails.object);
    view.aids.names.push(this.labels.object);
    view.beforeDraw((now) => this.#prepare(now));
    view.recolored.push((colors) => {
      this.drawing.setColors(colors);
      this.change();
    });
  }

  /** Something that is drawn has changed. */
  change() {
    this.#isDirty = true;
    this.labels.refresh();
    this.view.requestDraw();
  }

  /** After a `names` packet. */
  takeNames() {
    if (this.#fixed !== this.#frames.fixed) this.trails.clear();
    this.#fixed = this.#frames.fixed;
    this.#path = [];
    this.#selection = { source: -1, target: -1 };
    this.change();
  }

  /** After a `frames` packet. */
  takePoses() {
    const frames = this.#frames;
    if (!this.cameras.isTouched && !this.cameras.followed) this.#keepInView();
    this.#fitted = frames.version;
    this.cameras.take(frames);
    this.trails.take(frames);
    this.view.grid.setOrigin(frames.origin);
    this.#isDirty = true;
    this.view.requestDraw();
    this.#watchFading();
  }

  /** Highlight the path between two frames (indices, or -1). */
  select(source, target) {
    this.#selection = { source, target };
    this.#path = source >= 0 && target >= 0 ? this.#frames.path(source, target) : [];
    this.change();
    return this.#path;
  }

  /** Name the frame under the pointer, here or in the tree; -1 for none. */
  hover(k) {
    this.#picking.hovered = k;
    this.labels.refresh();
    this.view.requestDraw();
  }

  /** Show everything, displays too, with sizes that fit. From then on the camera is the user's. */
  fit() {
    this.cameras.isTouched = true;
    this.#look(extentOf(this.#frames, this.view.displays));
  }

  /** Length of the axes, chosen by the user [m]. */
  setSize(metres) {
    this.#sizeIsChosen = true;
    this.drawing.size = metres;
    this.change();
  }

  /** When a display has its first content or more of it, or the picture another size. */
  takeDisplay() {
    if (!this.cameras.isTouched && !this.cameras.followed) this.#keepInView(true);
  }

  /** Until the user takes the camera, it shows frames and displays, also when they move away. */
  #keepInView(isNew = this.#fitted !== this.#frames.version) {
    const now = performance.now();
    if (!isNew && now - this.#lookedAt < KEEP_MS) return;
    this.#lookedAt = now;
    const extent = crowdOf(this.#frames, this.view.displays);
    const seen = this.#seen;
    if (!extent) return;
    const moved = seen ? extent.middle.clone().sub(seen.middle) : null;
    if (isNew || !seen || extent.radius > 1.5 * seen.radius) {
      this.#look(extent);
      this.#seen = extent;
    } else if (extent.isApart || moved.length() > 0.6 * seen.radius) {
      this.cameras.move(moved);
      seen.middle = extent.middle;
    }
  }

  #look(extent) {
    if (!extent) return;
    if (!this.#sizeIsChosen) this.drawing.size = sizeFor(this.#frames, extent.radius);
    this.view.grid.setCell(cellFor(extent.radius));
    const { size } = this.drawing;
    const box = extent.box.clone().expandByScalar(size); // axes stand out of it
    this.cameras.look(extent.middle, extent.radius + size, box, this.#covered());
    this.change();
    this.#onLook();
  }

  /** How much of the picture's upper side lies below rows of buttons [CSS pixels]. */
  #covered() {
    const picture = this.view.canvas.getBoundingClientRect();
    const rows = [...this.view.canvas.parentElement.querySelectorAll(".bar")]
      .map((bar) => bar.getBoundingClientRect())
      .filter(({ width, height }) => width > height);
    return Math.max(0, ...rows.map(({ bottom }) => bottom - picture.top));
  }

  #prepare(now) {
    if (this.#isDirty) this.drawing.update(this.#frames, this.#path);
    this.#isDirty = false;
    this.labels.update(this.#frames, this.#important(), now);
    clearTimeout(this.#settling);
    this.#settling = setTimeout(() => this.#settle(), SETTLE_MS);
  }

  #settle() {
    if (!this.labels.isCurrent(this.#frames, this.#important())) this.view.requestDraw();
  }

  #important() {
    const important = new Map();
    const { roots } = this.#frames;
    if (roots.length > 1) for (const root of roots) important.set(this.#frames.index(root), "root");
    for (const k of this.#path) important.set(k, "path");
    if (this.#picking.hovered >= 0) important.set(this.#picking.hovered, "hovered");
    const { source, target } = this.#selection;
    if (source >= 0 && target >= 0) important.set(target, "target");
    if (source >= 0) important.set(source, "selected");
    return important;
  }

  /** Frames that no longer move fade with time, without packets. */
  #watchFading() {
    if (this.#fading !== null) return;
    this.#fading = setInterval(() => {
      this.#frames.ages.tick();
      if (!this.#frames.ages.isFading) return;
      this.#isDirty = true;
      this.view.requestDraw();
    }, FADING_MS);
  }
}
