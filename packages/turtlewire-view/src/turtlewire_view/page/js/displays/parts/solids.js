// Arrows, axes and simple bodies; many of one kind in one draw call.

import {
  BoxGeometry, ConeGeometry, CylinderGeometry, Group, InstancedMesh, Matrix4, Mesh,
  MeshLambertMaterial, Quaternion, SphereGeometry, Vector3,
} from "three";
import { litColor, opacity } from "./common.js";

const X = new Vector3(1, 0, 0);
const AXES = [
  { turn: new Quaternion(), color: [224, 47, 63] },
  { turn: new Quaternion(0, 0, Math.SQRT1_2, Math.SQRT1_2), color: [20, 154, 78] },
  { turn: new Quaternion(0, -Math.SQRT1_2, 0, Math.SQRT1_2), color: [47, 91, 234] },
];
const FEW = 200;

/** A cylinder of length 1 and diameter 1 from the origin along x. */
function rod(sides) {
  return new CylinderGeometry(0.5, 0.5, 1, sides).rotateZ(-Math.PI / 2).translate(0.5, 0, 0);
}

/** A cone of length 1 and diameter 1 from the origin along x. */
function tip(sides) {
  return new ConeGeometry(0.5, 1, sides).rotateZ(-Math.PI / 2).translate(0.5, 0, 0);
}

function material(color, alpha) {
  return new MeshLambertMaterial({ color: litColor(color), ...opacity(alpha) });
}

/**
 * Arrows in one colour (RGBA bytes). Each of `arrows` has `at` and `turn` (it points along x), and
 * `shaft` and `head` as [length, diameter].
 */
export function makeArrows(arrows, color) {
  const sides = arrows.length > FEW ? 6 : 12;
  const group = new Group();
  const look = material(color, color[3] / 255);
  const shafts = new InstancedMesh(rod(sides), look, arrows.length);
  const heads = new InstancedMesh(tip(sides), look.clone(), arrows.length);
  const matrix = new Matrix4();
  const size = new Vector3();
  const front = new Vector3();
  arrows.forEach(({ at, turn, shaft, head }, k) => {
    shafts.setMatrixAt(k, matrix.compose(at, turn, size.set(shaft[0], shaft[1], shaft[1])));
    front.copy(X).multiplyScalar(shaft[0]).applyQuaternion(turn).add(at);
    heads.setMatrixAt(k, matrix.compose(front, turn, size.set(head[0], head[1], head[1])));
  });
  for (const each of [shafts, heads]) each.frustumCulled = false;
  group.add(shafts, heads);
  return group;
}

/** An arrow between two points (Vector3); a head of length 0 takes 23 % of it, as in RViz. */
export function arrowBetween(from, to, [shaftDiameter, headDiameter, headLength]) {
  const along = to.clone().sub(from);
  const length = along.length();
  const head = Math.min(length, headLength > 0 ? headLength : 0.23 * length);
  return {
    at: from,
    turn: new Quaternion().setFromUnitVectors(X, length > 0 ? along.divideScalar(length) : X),
    shaft: [length - head, shaftDiameter],
    head: [head, headDiameter],
  };
}

/** Axes at each of `places` ({ at, turn }). */
export function makeAxes(places, length, radius) {
  const sides = places.length > FEW ? 5 : 10;
  const look = new MeshLambertMaterial();
  const rods = new InstancedMesh(rod(sides), look, 3 * places.length);
  const matrix = new Matrix4();
  const size = new Vector3(length, 2 * radius, 2 * radius);
  const turned = new Quaternion();
  places.forEach(({ at, turn }, k) => {
    AXES.forEach((axis, n) => {
      rods.setMatrixAt(3 * k + n, matrix.compose(at, turned.copy(turn).multiply(axis.turn), size));
      rods.setColorAt(3 * k + n, litColor(axis.color));
    });
  });
  rods.frustumCulled = false;
  return rods;
}

/** Poses of arrays of points and quaternions (xyzw). */
export function placesOf(points, rotations) {
  return Array.from({ length: points.length / 3 }, (_, k) => ({
    at: new Vector3().fromArray(points, 3 * k),
    turn: new Quaternion().fromArray(rotations, 4 * k),
  }));
}

/** The geometry of a body of size 1: box, sphere or cylinder along z; coarse for many. */
export function bodyGeometry(shape, isCoarse = false) {
  if (shape === "sphere") return new SphereGeometry(0.5, isCoarse ? 8 : 24, isCoarse ? 6 : 16);
  if (shape === "cylinder") {
    return new CylinderGeometry(0.5, 0.5, 1, isCoarse ? 10 : 28).rotateX(Math.PI / 2);
  }
  return new BoxGeometry(1, 1, 1);
}

/** One body; `color` as RGBA bytes. */
export function makeBody(shape, size, color) {
  const body = new Mesh(bodyGeometry(shape), material(color, color[3] / 255));
  body.scale.fromArray(size.map((value) => value || 1e-6));
  return body;
}

/**
 * Many bodies of one size at `points`; `colors` are RGBA bytes, one for all or one for each.
 * With `perDepth` the size is multiplied by z.
 */
export function makeBodies(shape, size, points, colors, { alpha = 1, perDepth = false } = {}) {
  const count = points.length / 3;
  const isPerPoint = colors.length > 4;
  const look = material(isPerPoint ? [255, 255, 255] : colors, alpha * (colors[3] ?? 255) / 255);
  const bodies = new InstancedMesh(bodyGeometry(shape, count > FEW), look, count);
  const sides = size.map((value) => value || 1e-6);
  const matrix = new Matrix4().makeScale(...sides);
  for (let k = 0; k < count; k += 1) {
    const z = points[3 * k + 2];
    if (perDepth) matrix.makeScale(...sides.map((side) => side * z));
    matrix.setPosition(points[3 * k], points[3 * k + 1], points[3 * k + 2]);
    bodies.setMatrixAt(k, matrix);
    if (isPerPoint) bodies.setColorAt(k, litColor(colors.subarray(4 * k, 4 * k + 3)));
  }
  bodies.frustumCulled = false;
  return bodies;
}
