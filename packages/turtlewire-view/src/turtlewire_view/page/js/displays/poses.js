// Poses as arrows or axes: one with its covariance, many, and paths.

import {
  CircleGeometry, DoubleSide, Group, Mesh, MeshBasicMaterial, MeshLambertMaterial, Quaternion,
  SphereGeometry, Vector3,
} from "three";

import { bytesOf, Display, litColor, opacity, setPose } from "./parts/common.js";
import { makeRibbons } from "./parts/ribbons.js";
import { makeArrows, makeAxes, placesOf } from "./parts/solids.js";

const POSITION_COLOR = [204, 51, 204];
const YAW_COLOR = [255, 255, 127];
const ARROW = { shaft: [0.1, 0.1], head: [0.2, 0.3] };
const ARROW_COLOR = bytesOf("#ff55ff");

/** PoseStamped, PoseWithCovarianceStamped, and the last poses of Odometry. */
export class Pose extends Display {
  draw(group, header) {
    group.add(makePose(header, this.options));
  }
}

/** Many poses as arrows or axes. */
export class PoseArray extends Display {
  draw(group, _header, { points, rotations }) {
    const { shape, color, alpha, length } = this.options;
    const places = placesOf(points, rotations);
    const size = { shaft: [0.77 * length, 0.04 * length], head: [0.23 * length, 0.15 * length] };
    if (shape === "axes") group.add(makeAxes(places, length, 0.03 * length));
    else {
      const arrows = places.map((place) => ({ ...place, ...size }));
      group.add(makeArrows(arrows, bytesOf(color, alpha)));
    }
  }
}

/** A line, and its poses as axes or arrows. */
export class Path extends Display {
  draw(group, _header, { points, rotations }) {
    const { color, width, alpha, pose_style: style } = this.options;
    group.add(makeRibbons(points, bytesOf(color), { width, alpha }));
    if (!rotations || style === "none") return;
    const places = placesOf(points, rotations);
    if (style === "axes") group.add(makeAxes(places, 0.3, 0.03));
    else group.add(makeArrows(places.map((place) => ({ ...place, ...ARROW })), ARROW_COLOR));
  }
}

/** The pose of a header's `at` and `covariance`. */
function makePose({ at, covariance }, options) {
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
