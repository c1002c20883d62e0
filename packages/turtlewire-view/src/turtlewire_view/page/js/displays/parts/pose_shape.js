// A pose as an arrow or axes, with its covariance.

import {
  CircleGeometry, DoubleSide, Group, Mesh, MeshBasicMaterial, MeshLambertMaterial, Quaternion,
  SphereGeometry, Vector3,
} from "three";
import { bytesOf, litColor, opacity, setPose } from "./common.js";
import { makeArrows, makeAxes } from "./solids.js";

const POSITION_COLOR = [204, 51, 204];
const YAW_COLOR = [255, 255, 127];

/** The pose of a header's `at` and `covariance`. */
export function makePose({ at, covariance }, options) {
  const { shape, color, alpha, length, show_covariance: showsCovariance } = options;
  const group = setPose(new Group(), at);
  const place = { at: new Vector3(), turn: new Quaternion() };
  if (shape === "axes") group.add(makeAxes([place], length, 0.1 * length));
  else {
    const parts = { shaft: [0.77 * length, 0.1 * length], head: [0.23 * length, 0.2 * length] };
    group.add(makeArrows([{ ...place, ...parts }], bytesOf(color, alpha)));
  }
  const both = new Group();
  both.add(group);
  if (covariance && showsCovariance) both.add(ellipsoid(at, covariance), wedge(at, covariance.yaw));
  return both;
}

/** One standard deviation of the position; its axes are those of the message's frame. */
function ellipsoid(at, { radii, rotation }) {
  const look = new MeshLambertMaterial({ color: litColor(POSITION_COLOR), ...opacity(0.3) });
  const body = new Mesh(new SphereGeometry(1, 24, 16), look);
  body.position.fromArray(at);
  body.quaternion.fromArray(rotation);
  body.scale.fromArray(radii.map((radius) => Math.max(radius, 1e-3)));
  return body;
}

/** One standard deviation of the heading to both sides. */
function wedge(at, yaw) {
  const geometry = new CircleGeometry(1, 24, -yaw, 2 * yaw);
  const color = litColor(YAW_COLOR);
  const look = new MeshBasicMaterial({ color, side: DoubleSide, ...opacity(0.5) });
  const fan = setPose(new Mesh(geometry, look), at);
  fan.visible = yaw > 0;
  return fan;
}
