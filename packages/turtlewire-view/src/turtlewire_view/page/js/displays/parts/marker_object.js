// What is drawn of a marker's header and arrays, with its mesh or texture when these are loaded.
// Images on triangles, from bytes that came with a message or from the server.
// One marker of each type; positions are relative to the marker's pose.

import {
  BufferAttribute, BufferGeometry, Color, DoubleSide, Mesh, MeshLambertMaterial, Quaternion,
  RepeatWrapping, SRGBColorSpace, Texture, Vector3,
} from "three";

import { free, litColor, opacity } from "./common.js";
import { loadMesh, makePlaceholder, paint } from "./meshes.js";
import { makePoints } from "./points.js";
import { makeRibbons } from "./ribbons.js";
import { arrowBetween, makeArrows, makeBodies, makeBody } from "./solids.js";
import { makeText } from "./text.js";

/**
 * The texture of a header's `texture` ({ url, name }), or of encoded `bytes`; v goes down.
 * Raises an Error that says what is wrong.
 */
export async function loadTexture({ url, name }, bytes) {
  const blob = bytes ? new Blob([bytes]) : await fetchImage(url, name);
  let bitmap;
  try {
    bitmap = await createImageBitmap(blob);
  } catch {
    throw new Error(`'${name}' is not an image that this browser can read`);
  }
  const texture = new Texture(bitmap);
  texture.flipY = false;
  texture.colorSpace = SRGBColorSpace;
  texture.wrapS = texture.wrapT = RepeatWrapping;
  texture.needsUpdate = true;
  texture.addEventListener("dispose", () => bitmap.close());
  return texture;
}

async function fetchImage(url, name) {
  const address = new URL(`.${url}`, document.baseURI); // the page may have its own path
  const answer = await fetch(address);
  if (!answer.ok) throw new Error(`'${name}' cannot be loaded: ${(await answer.text()).trim()}`);
  return answer.blob();
}

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

/** Add the object of a marker to `holder`; `view` gets problems, which begin with `name`. */
export function addMarker(holder, marker, arrays, view, name) {
  if (marker.shape === "mesh") {
    addMesh(holder, marker, arrays, view, name);
    return;
  }
  const points = rows(arrays.points, marker.points, 3);
  const object = makeMarker(marker, points, rows(arrays.colors, marker.colors, 4));
  holder.add(object);
  if (marker.texture) addTexture(object, marker, arrays, view, name);
}

async function addMesh(holder, marker, { files }, view, name) {
  const { mesh, scale, color, file, embedded_materials: keepsOwn } = marker;
  const bytes = file[1] ? rows(files, file, 1).slice().buffer : null;
  let object;
  try {
    const loaded = await loadMesh(mesh, bytes);
    object = loaded.object;
    if (loaded.problem) view.report?.(`${name}: ${loaded.problem}`);
    if (!keepsOwn || !loaded.isOwn) paint(object, color);
    const alpha = color[3] / 255;
    if (alpha < 1 && !keepsOwn) makeClear(object, alpha);
    object.scale.set(...scale.map((value) => value || 1e-6));
  } catch (error) {
    object = makePlaceholder();
    view.report?.(`${name}: ${error.message}`);
  }
  if (holder.parent) holder.add(object);
  else free(object);
  view.requestDraw();
}

async function addTexture(object, marker, { files, uv }, view, name) {
  const { geometry, material } = object;
  const corners = rows(uv, marker.uv, 2).slice();
  const bytes = marker.file[1] ? rows(files, marker.file, 1).slice() : null;
  try {
    const texture = await loadTexture(marker.texture, bytes);
    if (!object.parent?.parent) return texture.dispose(); // another one has come meanwhile
    geometry.setAttribute("uv", new BufferAttribute(corners, 2));
    Object.assign(material, { map: texture, needsUpdate: true });
  } catch (error) {
    view.report?.(`${name}: ${error.message}`);
  }
  view.requestDraw();
}

/** The rows of an array that [first, count] tell; `width` numbers in each. */
function rows(array, [first, count], width) {
  return array.subarray(width * first, width * (first + count));
}

function makeClear(object, alpha) {
  object.traverse((each) => {
    if (each.isMesh) Object.assign(each.material, { opacity: alpha, transparent: true });
  });
}
