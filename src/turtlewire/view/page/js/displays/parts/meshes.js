// Files of meshes: STL, DAE, OBJ, GLB; a box stands for what cannot be loaded.

import {
  Box3, BoxGeometry, EdgesGeometry, Group, LineBasicMaterial, LineSegments, Mesh,
  MeshLambertMaterial,
} from "three";
import { free, litColor } from "./common.js";

const PLACEHOLDER_SIZE = 0.1;
const PLACEHOLDER_COLOR = "#e0405a";
const PLAIN_COLOR = [200, 10, 10]; // RViz's, of what has no material
/** Format to what makes an object of the bytes; loaders come when the first file needs them. */
const PARSERS = {
  stl: async (bytes) => {
    const { STLLoader } = await import("three/addons/loaders/STLLoader.js");
    const geometry = new STLLoader().parse(bytes);
    return new Mesh(geometry, new MeshLambertMaterial({ vertexColors: geometry.hasColors }));
  },
  obj: async (bytes) => {
    const { OBJLoader } = await import("three/addons/loaders/OBJLoader.js");
    return new OBJLoader().parse(new TextDecoder().decode(bytes));
  },
  dae: async (bytes, folder) => {
    const { ColladaLoader } = await import("three/addons/loaders/ColladaLoader.js");
    const text = new TextDecoder().decode(bytes);
    const loaded = /<COLLADA[\s>]/.test(text) && new ColladaLoader().parse(text, folder);
    if (!loaded) throw new Error("this is no COLLADA");
    loaded.scene.rotation.set(0, 0, 0); // RViz takes the numbers as they are, whatever is "up"
    return loaded.scene;
  },
  glb: async (bytes, folder) => {
    const { GLTFLoader } = await import("three/addons/loaders/GLTFLoader.js");
    return (await new GLTFLoader().parseAsync(bytes, folder)).scene;
  },
};
PARSERS.gltf = PARSERS.glb;

/** Names and URLs to promises of objects; each user gets a copy. */
const known = new Map();

/**
 * The object of a header's `mesh` ({ url, name } or { problem, name }), or of `bytes`.
 * `isOwn` tells whether it brings its own materials. Raises an Error that says what is wrong.
 */
export async function loadMesh(mesh, bytes = null) {
  if (mesh.problem) throw new Error(mesh.problem);
  if (bytes) return parse(mesh.name, bytes, "");
  if (!known.has(mesh.url)) {
    known.set(mesh.url, fetchMesh(mesh));
    known.get(mesh.url).catch(() => known.delete(mesh.url)); // it may be there the next time
  }
  const { object, isOwn } = await known.get(mesh.url);
  return { object: copyOf(object), isOwn };
}

/** A box of wires in place of a mesh. */
export function makePlaceholder() {
  const box = new BoxGeometry(PLACEHOLDER_SIZE, PLACEHOLDER_SIZE, PLACEHOLDER_SIZE);
  const edges = new EdgesGeometry(box);
  box.dispose();
  return new LineSegments(edges, new LineBasicMaterial({ color: PLACEHOLDER_COLOR }));
}

/** Paint all of an object in a colour (RGB bytes), or what has no material of its own. */
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
  const address = new URL(`.${url}`, document.baseURI); // the page may have a path of its own
  const answer = await fetch(address);
  if (!answer.ok) throw new Error(`'${name}' cannot be loaded: ${(await answer.text()).trim()}`);
  const bytes = await answer.arrayBuffer();
  return parse(name, bytes, address.href.slice(0, address.href.lastIndexOf("/") + 1));
}

async function parse(name, bytes, folder) {
  const format = name.split(".").pop().toLowerCase();
  if (!Object.hasOwn(PARSERS, format)) {
    throw new Error(`'${name}' is none of ${Object.keys(PARSERS).join(", ")}`);
  }
  let object;
  try {
    object = await PARSERS[format](bytes, folder);
  } catch (error) {
    throw new Error(`'${name}' is no ${format.toUpperCase()} that can be read: ${error.message}`);
  }
  keepSolids(object);
  const extent = new Box3().setFromObject(object);
  if (extent.isEmpty() || ![...extent.min, ...extent.max].every(Number.isFinite)) {
    free(object);
    throw new Error(`'${name}' holds no triangles that can be drawn`);
  }
  const holder = new Group(); // the object has a scale and a turn of its own
  holder.add(object);
  return { object: holder, isOwn: format !== "stl" && format !== "obj" };
}

/** Lights and cameras of a file are not ours. */
function keepSolids(object) {
  const others = [];
  object.traverse((each) => {
    if (each.isLight || each.isCamera) others.push(each);
  });
  for (const each of others) each.removeFromParent();
}

/** A copy with materials of its own. */
function copyOf(object) {
  const copy = object.clone();
  copy.traverse((each) => {
    if (!each.isMesh) return;
    const copies = [each.material].flat().map((material) => material.clone());
    each.material = Array.isArray(each.material) ? copies : copies[0];
  });
  return copy;
}
