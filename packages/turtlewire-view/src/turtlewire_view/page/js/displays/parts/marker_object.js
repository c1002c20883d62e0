// What is drawn of a marker's header and arrays, with its mesh or texture when these are loaded.

import { BufferAttribute } from "three";
import { free } from "./common.js";
import { makeMarker } from "./marker_shapes.js";
import { loadMesh, makePlaceholder, paint } from "./meshes.js";
import { loadTexture } from "./textures.js";

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
