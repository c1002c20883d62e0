// Files of meshes: STL, DAE, OBJ, GLB; a box replaces a mesh that cannot be loaded.

import {
  Box3, BoxGeometry, EdgesGeometry, Group, LineBasicMaterial, LineSegments, LoadingManager, Mesh,
  MeshLambertMaterial,
} from "three";
import { free, litColor } from "./common.js";

const PLACEHOLDER_SIZE = 0.1;
const PLACEHOLDER_COLOR = "#e0405a";
const PLAIN_COLOR = [200, 10, 10]; // RViz's, of what has no material
/**
 * Format to what makes `object` of bytes, and tells whether it `isOwn`, with materials of its own.
 * Loaders come when the first file needs them; images are asked for by way of the `manager`.
 */
const PARSERS = {
  stl: async (bytes) => {
    const { STLLoader } = await import("three/addons/loaders/STLLoader.js");
    const geometry = new STLLoader().parse(bytes);
    if (lacksNormals(geometry)) geometry.computeVertexNormals();
    const look = new MeshLambertMaterial({ vertexColors: geometry.hasColors ?? false });
    return { object: new Mesh(geometry, look), isOwn: false };
  },
  obj: async (bytes, folder, manager) => {
    const { OBJLoader } = await import("three/addons/loaders/OBJLoader.js");
    const text = new TextDecoder().decode(bytes);
    const materials = await loadMaterials(text, folder, manager);
    const object = new OBJLoader(manager).setMaterials(materials).parse(text);
    return { object, isOwn: materials !== null };
  },
  dae: async (bytes, folder, manager) => {
    const { ColladaLoader } = await import("three/addons/loaders/ColladaLoader.js");
    const text = new TextDecoder().decode(bytes);
    const loaded = /<COLLADA[\s>]/.test(text) && new ColladaLoader(manager).parse(text, folder);
    if (!loaded) throw new Error("this is not COLLADA");
    loaded.scene.rotation.set(0, 0, 0); // RViz takes the numbers as they are, whatever is "up"
    return { object: loaded.scene, isOwn: /<instance_material[\s>]/.test(text) };
  },
  glb: async (bytes, folder) => {
    const { GLTFLoader } = await import("three/addons/loaders/GLTFLoader.js");
    return { object: (await new GLTFLoader().parseAsync(bytes, folder)).scene, isOwn: true };
  },
};
PARSERS.gltf = PARSERS.glb;

/** Whether a normal has no length: some programs write zeros, and RViz computes those normals. */
function lacksNormals(geometry) {
  const { array } = geometry.attributes.normal;
  for (let at = 0; at < array.length; at += 3) {
    if (!array[at] && !array[at + 1] && !array[at + 2]) return true;
  }
  return false;
}

/** Names and URLs to promises of objects; each user gets a copy. */
const known = new Map();

/**
 * The object of a header's `mesh` ({ url, name } or { problem, name }), or of `bytes`.
 * `isOwn` tells whether it brings its own materials, `problem` which file of these is missing.
 * Raises an Error that says what is wrong.
 */
export async function loadMesh(mesh, bytes = null) {
  if (mesh.problem) throw new Error(mesh.problem);
  if (bytes) return parse(mesh.name, bytes, "");
  if (!known.has(mesh.url)) {
    known.set(mesh.url, fetchMesh(mesh));
    known.get(mesh.url).catch(() => known.delete(mesh.url)); // it may be there the next time
  }
  const { object, ...rest } = await known.get(mesh.url);
  return { object: copyOf(object), ...rest };
}

/** A wireframe box in place of a mesh. */
export function makePlaceholder() {
  const box = new BoxGeometry(PLACEHOLDER_SIZE, PLACEHOLDER_SIZE, PLACEHOLDER_SIZE);
  const edges = new EdgesGeometry(box);
  box.dispose();
  return new LineSegments(edges, new LineBasicMaterial({ color: PLACEHOLDER_COLOR }));
}

/** Paint an object in a colour (RGB bytes): all of it, or the parts without a material. */
export function paint(object, color) {
  const tint = litColor(color ?? PLAIN_COLOR);
  object.traverse((each) => {
    if (!each.isMesh) return;
    for (const material of [each.material].flat()) material.dispose();
    const isTinted = !color && each.geometry.hasAttribute("color");
    const look = isTinted ? { vertexColors: true } : { color: tint };
    each.material = new MeshLambertMaterial(look);
  });
}

async function fetchMesh({ url, name }) {
  const address = new URL(`.${url}`, document.baseURI); // the page may have its own path
  const answer = await fetch(address);
  if (!answer.ok) throw new Error(`'${name}' cannot be loaded: ${(await answer.text()).trim()}`);
  const bytes = await answer.arrayBuffer();
  return parse(name, bytes, address.href.slice(0, address.href.lastIndexOf("/") + 1));
}

async function parse(name, bytes, folder) {
  const format = name.split(".").pop().toLowerCase();
  if (!Object.hasOwn(PARSERS, format)) {
    throw new Error(`'${name}' is not one of ${Object.keys(PARSERS).join(", ")}`);
  }
  const manager = new LoadingManager();
  let problem = "";
  let images = null;
  manager.onStart = () => (images = new Promise((resolve) => (manager.onLoad = resolve)));
  manager.onError = (url) => {
    problem ||= `'${name}' needs '${url.split("/").pop()}', which cannot be loaded`;
  };
  let object, isOwn;
  try {
    ({ object, isOwn } = await PARSERS[format](bytes, folder, manager));
  } catch (error) {
    throw new Error(`'${name}' is not a readable ${format.toUpperCase()} file: ${error.message}`);
  }
  await images;
  keepSolids(object);
  const extent = new Box3().setFromObject(object);
  if (extent.isEmpty() || ![...extent.min, ...extent.max].every(Number.isFinite)) {
    free(object);
    throw new Error(`'${name}' contains no triangles to draw`);
  }
  const holder = new Group(); // the object has its own scale and rotation
  holder.add(object);
  return { object: holder, isOwn, problem };
}

/** The materials that the text of an OBJ file names, or null if it has none or they are missing. */
async function loadMaterials(text, folder, manager) {
  const names = [...text.matchAll(/^mtllib\s+(.+?)\s*$/gm)].map((found) => found[1]);
  const wanted = folder ? names : []; // bytes that came with a message have no files beside them
  const texts = await Promise.all(wanted.map((name) => fetchText(folder + name, manager)));
  const found = texts.filter((each) => each !== null);
  if (!found.length) return null;
  const { MTLLoader } = await import("three/addons/loaders/MTLLoader.js");
  return new MTLLoader(manager).parse(found.join("\n"), folder);
}

async function fetchText(url, manager) {
  const answer = await fetch(url);
  if (answer.ok) return answer.text();
  manager.itemError(url);
  return null;
}

/** Lights and cameras of a file are not ours. */
function keepSolids(object) {
  const others = [];
  object.traverse((each) => {
    if (each.isLight || each.isCamera) others.push(each);
  });
  for (const each of others) each.removeFromParent();
}

/** A copy with its own materials. */
function copyOf(object) {
  const copy = object.clone();
  copy.traverse((each) => {
    if (!each.isMesh) return;
    const copies = [each.material].flat().map((material) => material.clone());
    each.material = Array.isArray(each.material) ? copies : copies[0];
  });
  return copy;
}
