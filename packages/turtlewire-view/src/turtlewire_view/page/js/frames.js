// The data of all frames: names, parents, poses and ages.

import { AgeClock } from "./age_clock.js";
import { offsetsOfTrees } from "./trees.js";

const POSE = 7;
const NO_POSE = [0, 0, 0, 0, 0, 0, 1];

/**
 * Frames are known by their index in `names`. Poses are [x, y, z, qx, qy, qz, qw] in the fixed
 * frame [m], less the server's `origin`; those of other trees are in their own root, and
 * `offset(k)` tells where that stands in the picture.
 */
export class Frames {
  version = -1;
  names = [];
  parents = [];
  trees = [];
  roots = [];
  fixed = "";
  origin = [0, 0, 0];
  stamp = 0;
  poses = new Float32Array(0);
  stamps = new Float64Array(0);
  known = new Uint8Array(0);
  /** Hidden by the user. */
  hidden = new Uint8Array(0);
  ages = new AgeClock();
  #indices = new Map();
  #offsets = [];

  get count() {
    return this.names.length;
  }

  /** Take a `names` packet. Poses are unknown until the next `frames` packet. */
  takeNames({ version, names, parents, trees, roots, fixed }) {
    Object.assign(this, { version, names, parents, trees, roots, fixed });
    this.#indices = new Map(names.map((name, k) => [name, k]));
    this.poses = new Float32Array(names.flatMap(() => NO_POSE));
    this.stamps = new Float64Array(names.length);
    this.known = new Uint8Array(names.length);
    this.hidden = new Uint8Array(names.length);
    this.#offsets = roots.map(() => [0, 0, 0]);
    this.ages.rename(names);
  }

  /** Take a `frames` packet; says whether it belonged to the present names. */
  takePoses({ version, stamp, origin, arrays }) {
    if (version !== this.version || arrays.known.length !== this.count) return false;
    Object.assign(this, { stamp, origin, ...arrays });
    this.ages.take(this.stamps, this.known);
    this.#offsets = offsetsOfTrees(this, this.#offsets);
    return true;
  }

  /** Index of a frame, or -1. */
  index(name) {
    return this.#indices.get(name) ?? -1;
  }

  /** Whether the frame is in the picture. */
  isShown(k) {
    return this.known[k] === 1 && this.hidden[k] === 0 && this.ages.isAlive(k);
  }

  /** Where the root of the frame's tree stands in the picture. */
  offset(k) {
    return this.#offsets[this.trees[k]];
  }

  /** Whether the frame belongs to the tree of the fixed frame. */
  isConnected(k) {
    const fixed = this.index(this.fixed);
    return fixed < 0 || this.trees[k] === this.trees[fixed];
  }

  /** Where the frame is in the picture, written to `to` as x, y, z. */
  position(k, to = [0, 0, 0]) {
    const offset = this.offset(k);
    for (let i = 0; i < 3; i += 1) to[i] = this.poses[POSE * k + i] + offset[i];
    return to;
  }

  /** The pose in the picture, or null while it is unknown. */
  poseOf(name) {
    const k = this.index(name);
    if (k < 0 || !this.known[k]) return null;
    return [...this.position(k), ...this.poses.subarray(POSE * k + 3, POSE * k + POSE)];
  }

  /** Indices from one frame over the common ancestor to the other; empty between two trees. */
  path(from, to) {
    const up = this.#ancestors(from);
    const down = this.#ancestors(to);
    const meeting = up.find((k) => down.includes(k));
    if (meeting === undefined) return [];
    const last = down.slice(0, down.indexOf(meeting)).reverse();
    return [...up.slice(0, up.indexOf(meeting) + 1), ...last];
  }

  #ancestors(k) {
    const found = [];
    for (let at = k; at >= 0 && !found.includes(at); at = this.parents[at]) found.push(at);
    return found;
  }
}
