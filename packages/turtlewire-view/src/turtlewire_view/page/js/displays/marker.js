// Marker and MarkerArray: the markers by namespace and id, until their lifetimes end.

import { BufferAttribute, Group } from "three";
import { clear, free, setPose } from "./parts/common.js";
import { makeMarker } from "./parts/marker_shapes.js";
import { loadMesh, makePlaceholder, paint } from "./parts/meshes.js";
import { loadTexture } from "./parts/textures.js";

/** Longest time that a browser's timer can wait [s]. */
const LONGEST_TIMER_S = 2e6;
/** Namespaces that the panel lists. */
const MOST_NAMES = 1000;

export default class Marker {
  #view;
  #hidden;
  #chosen = {};
  #named = new Set(); // namespaces that there were
  #held = new Map(); // namespace and id to { holder, namespace, timer }

  constructor(view, options) {
    this.#view = view;
    this.setOptions(options);
  }

  show(group, header, arrays) {
    if (header.clear) for (const key of [...this.#held.keys()]) this.#drop(key);
    for (const pair of header.delete ?? []) this.#drop(JSON.stringify(pair));
    if (!header.markers) return;
    clear(group);
    for (const marker of header.markers) this.#add(group, marker, arrays);
  }

  setOptions({ hidden, namespaces }) {
    this.#hidden = regexOf(hidden);
    this.#chosen = namespaces ?? {};
    for (const { holder, namespace } of this.#held.values()) {
      holder.visible = this.#isShown(namespace);
    }
  }

  dispose() {
    for (const key of [...this.#held.keys()]) this.#drop(key);
  }

  #add(group, marker, arrays) {
    const key = JSON.stringify(marker.key);
    this.#drop(key);
    const holder = setPose(new Group(), marker.pose);
    const [namespace] = marker.key;
    holder.visible = this.#isShown(namespace);
    this.#name(namespace);
    const entry = { holder, namespace, timer: null };
    this.#held.set(key, entry);
    group.add(holder);
    if (marker.shape === "mesh") this.#addMesh(holder, marker, arrays);
    else {
      const points = rows(arrays.points, marker.points, 3);
      const object = makeMarker(marker, points, rows(arrays.colors, marker.colors, 4));
      holder.add(object);
      if (marker.texture) this.#addTexture(object, marker, arrays);
    }
    if (marker.lifetime > 0) {
      const wait = 1000 * Math.min(marker.lifetime, LONGEST_TIMER_S);
      entry.timer = setTimeout(() => {
        this.#drop(key);
        this.#view.requestDraw();
      }, wait);
    }
  }

  async #addMesh(holder, marker, { files }) {
    const { mesh, scale, color, file, embedded_materials: keepsOwn } = marker;
    const bytes = file[1] ? rows(files, file, 1).slice().buffer : null;
    let object;
    try {
      const loaded = await loadMesh(mesh, bytes);
      object = loaded.object;
      if (loaded.problem) this.#view.report?.(`marker ${marker.key.join("/")}: ${loaded.problem}`);
      if (!keepsOwn || !loaded.isOwn) paint(object, color);
      const alpha = color[3] / 255;
      if (alpha < 1 && !keepsOwn) makeClear(object, alpha);
      object.scale.set(...scale.map((value) => value || 1e-6));
    } catch (error) {
      object = makePlaceholder();
      this.#view.report?.(`marker ${marker.key.join("/")}: ${error.message}`);
    }
    if (holder.parent) holder.add(object);
    else free(object);
    this.#view.requestDraw();
  }

  async #addTexture(object, marker, { files, uv }) {
    const { geometry, material } = object;
    const corners = rows(uv, marker.uv, 2).slice();
    const bytes = marker.file[1] ? rows(files, marker.file, 1).slice() : null;
    try {
      const texture = await loadTexture(marker.texture, bytes);
      if (!object.parent?.parent) return texture.dispose(); // another one has come meanwhile
      geometry.setAttribute("uv", new BufferAttribute(corners, 2));
      Object.assign(material, { map: texture, needsUpdate: true });
    } catch (error) {
      this.#view.report?.(`marker ${marker.key.join("/")}: ${error.message}`);
    }
    this.#view.requestDraw();
  }

  #isShown(namespace) {
    return this.#chosen[namespace]?.shown !== false && !this.#hidden?.test(namespace);
  }

  #name(namespace) {
    if (this.#named.has(namespace) || this.#named.size >= MOST_NAMES) return;
    this.#named.add(namespace);
    this.#view.offerItems?.("namespaces", [...this.#named]);
  }

  #drop(key) {
    const entry = this.#held.get(key);
    if (!entry) return;
    this.#held.delete(key);
    clearTimeout(entry.timer);
    entry.holder.removeFromParent();
    free(entry.holder);
  }
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

function regexOf(text) {
  try {
    return text ? new RegExp(text) : null;
  } catch {
    return null; // the user is still typing
  }
}
