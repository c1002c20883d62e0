// One marker of each type; positions are relative to the marker's pose.

import {
  BufferAttribute, BufferGeometry, Color, DoubleSide, Mesh, MeshLambertMaterial, Quaternion,
  SRGBColorSpace, Vector3,
} from "three";
import { litColor, opacity } from "./common.js";
import { makePoints } from "./points.js";
import { makeRibbons } from "./ribbons.js";
import { arrowBetween, makeArrows, makeBodies, makeBody } from "./solids.js";
import { makeText } from "./text.js";

/** Shape to what makes an object of a marker and its points and colours (perhaps none). */
const MAKERS = {
  arrow: makeArrow,
  cube: ({ scale, color }) => makeBody("box", scale, color),
  sphere: ({ scale, color }) => makeBody("sphere", scale, color),
  cylinder: ({ scale, color }) => makeBody("cylinder", scale, color),
  line_strip: ({ scale }, points, colors) => makeRibbons(points, colors, lineLook(scale)),
  line_list: ({ scale }, points, colors) => {
    return makeRibbons(points, colors, { ...lineLook(scale), pairs: true });
  },
  cube_list: ({ scale }, points, colors) => makeBodies("box", scale, points, colors),
  sphere_list: ({ scale }, points, colors) => makeBodies("sphere", scale, points, colors),
  points: ({ scale }, points, colors) => {
    const tints = repeated(colors, points.length / 3);
    return makePoints(points, tints, { size: scale[0], metres: true });
  },
  text: ({ text, scale, color }) => makeText(text, scale[2], color),
  triangle_list: makeTriangles,
  arrow_strip: makeArrowStrip,
};

/** The object of a marker that is no mesh. */
export function makeMarker(marker, points, colors) {
  return MAKERS[marker.shape](marker, points, colors.length ? colors : marker.color);
}

function lineLook(scale) {
  return { width: scale[0], least: 1.5 };
}

/** Along x by scale, or between two points; proportions are RViz's. */
function makeArrow({ scale, color }, points) {
  if (points.length >= 6) {
    const [from, to] = [0, 3].map((at) => new Vector3().fromArray(points, at));
    return makeArrows([arrowBetween(from, to, scale)], color);
  }
  const [length, width, height] = scale;
  const arrow = makeArrows([{
    at: new Vector3(),
    turn: new Quaternion(),
    shaft: [0.77 * length, 1],
    head: [0.23 * length, 2],
  }], color);
  arrow.scale.set(1, width || 1e-6, height || 1e-6);
  return arrow;
}

function makeArrowStrip({ scale, color }, points) {
  const corners = Array.from({ length: points.length / 3 }, (_, k) => {
    return new Vector3().fromArray(points, 3 * k);
  });
  const arrows = corners.slice(1).map((to, k) => arrowBetween(corners[k], to, scale));
  return makeArrows(arrows, color);
}

/** Colours are one for all, one for each corner or one for each triangle. */
function makeTriangles({ scale, color }, points, colors) {
  const count = points.length / 3;
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(points.slice(), 3));
  geometry.computeVertexNormals();
  const isColored = colors !== color;
  let clearest = color[3];
  if (isColored) {
    const tints = new Float32Array(3 * count);
    const corners = colors.length < 4 * count ? 3 : 1; // that share a colour
    const tint = new Color();
    for (let k = 0; k < count; k += 1) {
      const at = 4 * Math.floor(k / corners);
      tint.setRGB(colors[at] / 255, colors[at + 1] / 255, colors[at + 2] / 255, SRGBColorSpace);
      tint.toArray(tints, 3 * k);
    }
    geometry.setAttribute("color", new BufferAttribute(tints, 3));
    clearest = colors[3];
  }
  const look = isColored ? { vertexColors: true } : { color: litColor(color) };
  const mesh = new Mesh(geometry, new MeshLambertMaterial({
    ...look, ...opacity(clearest / 255), side: DoubleSide, flatShading: true,
  }));
  mesh.scale.fromArray(scale.map((value) => value || 1e-6));
  return mesh;
}

/** One colour for each of `count` points. */
function repeated(colors, count) {
  if (colors.length === 4 * count) return Uint8Array.from(colors);
  const bytes = new Uint8Array(4 * count);
  for (let k = 0; k < count; k += 1) bytes.set(colors.slice(0, 4), 4 * k);
  return bytes;
}
