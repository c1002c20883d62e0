// The controls of interactive markers: their handles, how they are dragged, and the pointer.

import {
  BufferAttribute, BufferGeometry, ConeGeometry, CylinderGeometry, DoubleSide, Mesh,
  MeshLambertMaterial, Plane, Quaternion, Raycaster, Vector2, Vector3,
} from "three";
import { mergeGeometries } from "three/addons/utils/BufferGeometryUtils.js";

import { litColor, opacity } from "./common.js";
import { makeText } from "./text.js";

const RING = { inner: 0.5, outer: 0.65, steps: 36 };
const ARROW = { from: 0.5, to: 0.9, shaft: 0.15, head: 0.25, tip: 0.2 };
const RING_MODES = new Set(["move_plane", "rotate_axis", "move_rotate"]);
const DARKER = 0.6; // every second part of a ring that turns
const TRANSPARENT = 0.5;
const TEXT_SIZE = 0.2;

/**
 * The handle of a control for a marker of size 1, or null; turned as the control is. `ink`: the
 * colour of texts (RGBA bytes).
 */
export function makeHandle({ mode, turn, description }, isTransparent, ink) {
  const rotation = new Quaternion().fromArray(turn);
  const look = new MeshLambertMaterial({
    color: litColor(colorOf(rotation)), side: DoubleSide,
    ...opacity(isTransparent ? TRANSPARENT : 1),
  });
  let handle = null;
  if (mode === "move_axis") handle = arrows(look);
  else if (RING_MODES.has(mode)) handle = ring(look, mode);
  else if (mode === "menu" && description) handle = makeText(description, TEXT_SIZE, ink);
  handle?.quaternion.copy(rotation);
  return handle;
}

/** Along x red, along y green, along z blue, and between them a mixture (RGB bytes). */
function colorOf(rotation) {
  const axis = new Vector3(1, 0, 0).applyQuaternion(rotation);
  const [x, y, z] = axis.toArray().map(Math.abs);
  const parts = [x / Math.max(y, z), y / Math.max(x, z), z / Math.max(x, y)];
  return parts.map((part) => 255 * Math.min(1, part));
}

function arrows(look) {
  const { from, to, shaft, head, tip } = ARROW;
  const rod = new CylinderGeometry(shaft / 2, shaft / 2, to - from - tip, 16);
  rod.rotateZ(-Math.PI / 2).translate((from + to - tip) / 2, 0, 0);
  const cone = new ConeGeometry(head / 2, tip, 16);
  cone.rotateZ(-Math.PI / 2).translate(to - tip / 2, 0, 0);
  const parts = [rod, cone, rod.clone().rotateZ(Math.PI), cone.clone().rotateZ(Math.PI)];
  const arrow = new Mesh(mergeGeometries(parts), look); // one draw call, for there may be many
  for (const part of parts) part.dispose();
  return arrow;
}

/** Around x; one that moves and turns has teeth, one that turns has two shades. */
function ring(look, mode) {
  const { inner, outer, steps } = RING;
  const places = [];
  const shades = [];
  const point = (radius, step) => {
    const angle = (2 * Math.PI * step) / steps;
    return [0, radius * Math.cos(angle), radius * Math.sin(angle)];
  };
  for (let k = 0; k < steps; k += 1) {
    const corners = [point(inner, k), point(outer, k), point(outer, k + 1), point(inner, k + 1)];
    const tooth = [point(outer, k), point(outer * 1.15, k + 0.5), point(outer, k + 1)];
    const triangles = [0, 1, 2, 0, 2, 3].map((n) => corners[n]);
    if (mode === "move_rotate" && k % 3 === 0) triangles.push(...tooth);
    const shade = mode !== "move_plane" && k % 2 ? DARKER : 1;
    for (const corner of triangles) {
      places.push(...corner);
      shades.push(shade, shade, shade);
    }
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(new Float32Array(places), 3));
  geometry.setAttribute("color", new BufferAttribute(new Float32Array(shades), 3));
  geometry.computeVertexNormals();
  look.vertexColors = true;
  return new Mesh(geometry, look);
}

const TURN_PER_PIXEL = 0.01; // [rad]
const LEAST_SINE = 0.02; // between a line or plane and the ray: nearer to it numbers explode

/**
 * A drag. `mode` is the control's; `axis` (unit Vector3), `position` and `turn` are those at its
 * start; `facing` is the direction to the eye. `start` and the argument of `to()` are
 * `{ ray, point, x, y, shiftKey, ctrlKey }`, with pixels x and y.
 */
export class ControlDrag {
  #mode;
  #axis;
  #facing;
  #up;
  #position;
  #turn;
  #grabbed; // the point that was pressed
  #last;

  constructor(mode, { axis, facing, up, position, turn }, start) {
    this.#mode = mode;
    this.#axis = axis;
    this.#facing = facing;
    this.#up = up;
    this.#position = position.clone();
    this.#turn = turn.clone();
    this.#grabbed = start.point.clone();
    this.#last = start;
  }

  /** The pose for the pointer: { position, turn }. */
  to(pointer) {
    this.#move(pointer);
    this.#last = pointer;
    return { position: this.#position.clone(), turn: this.#turn.clone() };
  }

  #move(pointer) {
    const mode = this.#mode;
    if (mode === "move_axis") this.#moveTo(nearestOnLine(this.#grabbed, this.#axis, pointer.ray));
    else if (mode === "move_plane") this.#moveTo(onPlane(pointer.ray, this.#axis, this.#grabbed));
    else if (mode === "rotate_axis") this.#rotateTo(pointer, false);
    else if (mode === "move_rotate") this.#rotateTo(pointer, true);
    else if (mode === "rotate_3d" || (mode === "move_rotate_3d" && pointer.ctrlKey)) {
      this.#rotateFreely(pointer);
    } else if (mode === "move_3d" || mode === "move_rotate_3d") this.#moveFreely(pointer);
  }

  /** The grabbed point follows the pointer. */
  #moveTo(place) {
    if (!place) return;
    this.#position.add(place).sub(this.#grabbed);
    this.#grabbed.copy(place);
  }

  /** Turn about the axis; with `pulls`, the grabbed point follows the pointer. */
  #rotateTo({ ray }, pulls) {
    const place = onPlane(ray, this.#axis, this.#grabbed);
    if (!place) return;
    const from = this.#away(this.#grabbed);
    const to = this.#away(place);
    if (from.lengthSq() > 0 && to.lengthSq() > 0) {
      const angle = Math.atan2(from.clone().cross(to).dot(this.#axis), from.dot(to));
      const by = new Quaternion().setFromAxisAngle(this.#axis, angle);
      this.#turn.premultiply(by).normalize();
      if (pulls) this.#position.add(to).sub(from.applyQuaternion(by));
    }
    this.#grabbed.copy(place);
  }

  /** A point from the marker's axis. */
  #away(point) {
    const by = point.clone().sub(this.#position);
    return by.addScaledVector(this.#axis, -by.dot(this.#axis));
  }

  #moveFreely(pointer) {
    if (!pointer.shiftKey) {
      this.#moveTo(onPlane(pointer.ray, this.#facing, this.#grabbed));
      return;
    }
    const away = this.#grabbed.distanceTo(pointer.ray.origin);
    const by = (this.#last.y - pointer.y) * TURN_PER_PIXEL * 0.5 * away;
    this.#moveTo(this.#grabbed.clone().addScaledVector(this.#facing, -by));
  }

  /** Right and left about the upright of the picture, up and down about its horizontal. */
  #rotateFreely({ x, y, shiftKey }) {
    const [across, down] = [x - this.#last.x, y - this.#last.y];
    const right = this.#up.clone().cross(this.#facing).normalize();
    const turns = shiftKey ? [[this.#facing, -across]] : [[this.#up, across], [right, down]];
    for (const [axis, pixels] of turns) {
      this.#turn.premultiply(new Quaternion().setFromAxisAngle(axis, pixels * TURN_PER_PIXEL));
    }
    this.#turn.normalize();
  }
}

/** The point of a line that is nearest to a ray; null if they are nearly parallel. */
function nearestOnLine(point, axis, { origin, direction }) {
  const along = direction.dot(axis);
  const sine = 1 - along * along;
  if (sine < LEAST_SINE * LEAST_SINE) return null;
  const by = origin.clone().sub(point);
  const far = (by.dot(axis) - by.dot(direction) * along) / sine;
  return point.clone().addScaledVector(axis, far);
}

/** The point where a ray meets the plane through a point; null if it runs along the plane. */
function onPlane(ray, normal, point) {
  if (Math.abs(ray.direction.dot(normal)) < LEAST_SINE) return null;
  const plane = new Plane().setFromNormalAndCoplanarPoint(normal, point);
  return ray.intersectPlane(plane, new Vector3());
}

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
