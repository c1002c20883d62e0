// Efforts of joints: a ring about the axis for a torque, an arrow along it for a force.

import { Group, Quaternion, Vector3 } from "three";

import { Display, setPose } from "./parts/common.js";
import { makeRibbons } from "./parts/ribbons.js";
import { arrowBetween, makeArrows } from "./parts/solids.js";

const UP = new Vector3(0, 0, 1);
/** Of the ring without an effort [m], and how much more the greatest effort has, as in RViz. */
const [LEAST_RADIUS, MORE_RADIUS] = [0.05, 0.5];
const [RING_POINTS, CIRCLE_POINTS] = [30, 32];

export default class Effort extends Display {
  #groups = new Map(); // part to group
  #newest = null;

  draw(group, { joints }) {
    for (const joint of joints) {
      if (this.options.joints?.[joint.name]?.shown === false) continue;
      const holder = new Group(); // at the frame of the joint
      holder.userData.frame = joint.frame;
      const turned = new Group();
      turned.quaternion.setFromUnitVectors(UP, new Vector3(...joint.axis));
      turned.add(this.#effort(joint));
      holder.add(turned);
      group.add(holder);
    }
    this.#place(group, false);
  }

  show(group, header, arrays) {
    super.show(group, header, arrays);
    this.#newest = group;
    this.#groups.set(header.part, group);
    this.view.offerItems?.("joints", header.joints.map(({ name }) => name));
    this.update();
  }

  removed(part) {
    super.removed(part);
    if (this.#groups.get(part) === this.#newest) this.#newest = null;
    this.#groups.delete(part);
  }

  /** The last efforts move with their joints; earlier ones stay where they were. */
  update() {
    if (!this.#newest) return;
    const missing = this.#place(this.#newest, true);
    const more = missing.length > 1 ? ` (and ${missing.length - 1} more)` : "";
    this.view.report?.(missing.length ? `No transform from [${missing[0]}]${more}` : "");
  }

  /** Returns the frames that have no pose. */
  #place(group, isNew) {
    const poses = (group.userData.poses ??= new Map());
    const missing = [];
    for (const holder of group.children) {
      const { frame } = holder.userData;
      if (isNew) poses.set(frame, this.view.poseOf(frame));
      const pose = poses.get(frame) ?? null;
      holder.visible = pose !== null;
      if (pose) setPose(holder, pose);
      else missing.push(frame);
    }
    return missing;
  }

  #effort({ shape, share, color }) {
    const { alpha, width, scale } = this.options;
    const size = LEAST_RADIUS + Math.abs(share) * scale * MORE_RADIUS;
    const look = { color, width, alpha, bytes: [...color.slice(0, 3), Math.round(255 * alpha)] };
    return shape === "ring" ? ring(size, share < 0, look) : arrow(size, share < 0, look);
  }
}

/** Most of a circle around z, with a head that says which way the torque turns. */
function ring(radius, isNegative, { color, width, alpha, bytes }) {
  const side = isNegative ? -1 : 1;
  const places = Array.from({ length: RING_POINTS }, (_, k) => {
    const angle = (2 * Math.PI * k) / CIRCLE_POINTS;
    return new Vector3(radius * Math.cos(angle), side * radius * Math.sin(angle), 0);
  });
  const points = new Float32Array(places.flatMap((place) => place.toArray()));
  const from = places.at(-2);
  const along = places.at(-1).clone().sub(from).normalize().multiplyScalar(3 * width);
  const head = arrowBetween(from, from.clone().add(along), [0, 2 * width, 3 * width]);
  const group = new Group();
  group.add(makeRibbons(points, color, { width, alpha }), makeArrows([head], bytes));
  return group;
}

function arrow(length, isNegative, { width, bytes }) {
  const end = new Vector3(0, 0, isNegative ? -length : length);
  const head = Math.min(3 * width, length / 2);
  return makeArrows([arrowBetween(new Vector3(), end, [width, 2.5 * width, head])], bytes);
}
