// Marker and MarkerArray: the markers by namespace and id, until their lifetimes end.

import { Group } from "three";
import { clear, free, setPose } from "./parts/common.js";
import { addMarker } from "./parts/marker_object.js";

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
    addMarker(holder, marker, arrays, this.#view, `marker ${marker.key.join("/")}`);
    if (marker.lifetime > 0) {
      const wait = 1000 * Math.min(marker.lifetime, LONGEST_TIMER_S);
      entry.timer = setTimeout(() => {
        this.#drop(key);
        this.#view.requestDraw();
      }, wait);
    }
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

function regexOf(text) {
  try {
    return text ? new RegExp(text) : null;
  } catch {
    return null; // the user is still typing
  }
}
