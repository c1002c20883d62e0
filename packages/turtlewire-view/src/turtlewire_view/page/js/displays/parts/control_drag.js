// How a drag of a control moves its marker; all in the frame of the marker's message.

import { Plane, Quaternion, Vector3 } from "three";

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
