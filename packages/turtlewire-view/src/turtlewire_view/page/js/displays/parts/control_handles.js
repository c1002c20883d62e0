// Handles of controls that bring no markers: arrows along x, or a ring around x, as in RViz.

import {
  BufferAttribute, BufferGeometry, ConeGeometry, CylinderGeometry, DoubleSide, Mesh,
  MeshLambertMaterial, Quaternion, Vector3,
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
