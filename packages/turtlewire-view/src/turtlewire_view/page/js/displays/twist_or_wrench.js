// TwistStamped, AccelStamped and WrenchStamped: an arrow, and one with a ring that turns about it.

import { Group, Quaternion, Vector3 } from "three";

import { bytesOf, Display } from "./parts/common.js";
import { makeRibbons } from "./parts/ribbons.js";
import { arrowBetween, makeArrows } from "./parts/solids.js";

const ORIGIN = new Vector3();
const UP = new Vector3(0, 0, 1);
/** Vectors that are shorter are not drawn, if small ones are hidden. */
const SMALL = 1e-3;
const RING_TURN = 1.75 * Math.PI;
const RING_POINTS = 40;

export default class TwistOrWrench extends Display {
  draw(group, { linear, angular }) {
    const { alpha, width, linear_color: straight, angular_color: turning } = this.options;
    if (this.#isShown(linear)) {
      const along = new Vector3(...linear).multiplyScalar(this.options.linear_scale);
      group.add(arrow(along, width, bytesOf(straight, alpha)));
    }
    if (!this.#isShown(angular)) return;
    const axis = new Vector3(...angular).multiplyScalar(this.options.angular_scale);
    group.add(arrow(axis, width, bytesOf(turning, alpha)));
    group.add(ring(axis, width, bytesOf(turning), alpha));
  }

  #isShown(vector) {
    const length = Math.hypot(...vector);
    return length > (this.options.hide_small_values ? SMALL : 0);
  }
}

function arrow(end, width, color) {
  const head = Math.min(0.5 * width, 0.5 * end.length());
  return makeArrows([arrowBetween(ORIGIN, end, [0.1 * width, 0.2 * width, head])], color);
}

/** Most of a circle around the middle of the axis, with a head that says which way it turns. */
function ring(axis, width, color, alpha) {
  const radius = axis.length() / 4;
  const places = Array.from({ length: RING_POINTS }, (_, k) => {
    const angle = (RING_TURN * k) / (RING_POINTS - 1);
    return new Vector3(radius * Math.cos(angle), radius * Math.sin(angle), 0);
  });
  const points = new Float32Array(places.flatMap((place) => place.toArray()));
  const group = new Group();
  const before = places.at(-2);
  const tip = places.at(-1).clone().sub(before).normalize().multiplyScalar(0.4 * width).add(before);
  const head = arrowBetween(before, tip, [0, 0.2 * width, 0.4 * width]);
  group.add(
    makeRibbons(points, color, { width: 0.06 * width, alpha }),
    makeArrows([head], [...color.slice(0, 3), Math.round(255 * alpha)]),
  );
  group.quaternion.copy(new Quaternion().setFromUnitVectors(UP, axis.clone().normalize()));
  group.position.copy(axis).multiplyScalar(0.5);
  return group;
}
