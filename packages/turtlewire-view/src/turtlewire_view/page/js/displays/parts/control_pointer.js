// The pointer on controls of interactive markers: what is under it, drags, clicks and menus.

import { Raycaster, Vector2 } from "three";

const DRAG = 5; // [CSS pixels] a right press that moves less opens a menu
const POINT_REACH = 0.05; // [m] around points of clouds

/**
 * Listens before the camera and the frames do. `objects()` gives what can be hit; `actions`:
 * hover(object or null), press(object, pointer) which returns whether a drag begins, drag(pointer),
 * release(pointer), menu(object, pointer). A pointer is `{ ray, point, x, y, shiftKey, ctrlKey }`.
 */
export class ControlPointer {
  #view;
  #objects;
  #actions;
  #ray = new Raycaster();
  #held = null; // pointerId of a drag
  #right = null; // { object, x, y } of a right press
  #around;
  #listeners = [];

  constructor(view, objects, actions) {
    this.#view = view;
    this.#objects = objects;
    this.#actions = actions;
    this.#ray.params.Points.threshold = POINT_REACH;
    this.#around = view.canvas.parentElement;
    this.#listen("pointerdown", (event) => this.#down(event));
    this.#listen("pointermove", (event) => this.#move(event));
    this.#listen("pointerup", (event) => this.#up(event));
    this.#listen("pointercancel", (event) => this.#up(event));
  }

  dispose() {
    for (const [kind, act] of this.#listeners) this.#around.removeEventListener(kind, act, true);
  }

  #listen(kind, act) {
    const onCanvas = (event) => {
      if (event.target === this.#view.canvas) act(event);
    };
    this.#around.addEventListener(kind, onCanvas, true);
    this.#listeners.push([kind, onCanvas]);
  }

  #down(event) {
    if (!event.isPrimary || this.#held !== null) return;
    const hit = this.#hit(event);
    if (!hit) return;
    if (event.button === 2) {
      this.#right = { ...hit, x: event.offsetX, y: event.offsetY };
      event.stopImmediatePropagation();
    } else if (event.button === 0) {
      event.stopImmediatePropagation();
      event.preventDefault();
      this.#view.canvas.setPointerCapture(event.pointerId);
      this.#held = event.pointerId;
      this.#actions.press(hit.object, this.#pointer(event, hit.point));
    }
  }

  #move(event) {
    if (this.#held === event.pointerId) {
      event.stopImmediatePropagation();
      this.#actions.drag(this.#pointer(event));
    } else if (!event.buttons) {
      const hit = this.#hit(event);
      this.#actions.hover(hit?.object ?? null);
      if (!hit) return;
      event.stopImmediatePropagation(); // no frame is under the pointer
      this.#view.canvas.style.cursor = "grab";
    }
  }

  #up(event) {
    if (this.#held === event.pointerId) {
      event.stopImmediatePropagation();
      this.#held = null;
      const hit = this.#hit(event);
      this.#actions.release(this.#pointer(event, hit?.point), hit?.object ?? null);
    } else if (event.button === 2 && this.#right) {
      const { object, point, x, y } = this.#right;
      this.#right = null;
      if (Math.hypot(event.offsetX - x, event.offsetY - y) > DRAG) return;
      this.#actions.menu(object, this.#pointer(event, point));
    }
  }

  #pointer(event, point = null) {
    const { offsetX: x, offsetY: y, shiftKey, ctrlKey } = event;
    this.#aim(event);
    return { ray: this.#ray.ray.clone(), point, x, y, shiftKey, ctrlKey };
  }

  #aim({ offsetX: x, offsetY: y }) {
    const { camera, viewport } = this.#view;
    camera.updateMatrixWorld();
    const at = new Vector2((2 * x) / viewport.width - 1, 1 - (2 * y) / viewport.height);
    this.#ray.setFromCamera(at, camera);
  }

  #hit(event) {
    this.#aim(event);
    const hits = this.#ray.intersectObjects(this.#objects(), true);
    return hits.find(({ object }) => isSeen(object)) ?? null;
  }
}

function isSeen(object) {
  for (let at = object; at; at = at.parent) if (!at.visible) return false;
  return true;
}
