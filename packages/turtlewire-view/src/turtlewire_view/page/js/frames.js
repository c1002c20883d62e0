// The data of all frames: names, parents, poses and ages.
// How long ago each frame's stamp changed, as RViz counts it, and how it fades.
// Which frames the user does not want to see.
// Places trees that are not connected to the fixed frame in a row next to it.

import { byId, setText } from "../kit/dom.js";

export const TIMEOUT_SECONDS = 15;

/**
 * A frame is as old as the time since its newest common time with the fixed frame changed, by this
 * page's clock: a bag of last year does not fade. Static frames have the stamp 0 and stay fresh.
 */
export class AgeClock {
  #names = [];
  #stamps = new Float64Array(0);
  #changed = new Float64Array(0);
  #static = new Uint8Array(0);
  #clock;
  #now = 0;
  #pausedAt = null;
  #paused = 0;

  /** `clock()`: seconds; the tests give their own. */
  constructor(clock = () => performance.now() / 1000) {
    this.#clock = clock;
  }

  /** A new set of frames; those that stay keep their age. */
  rename(names) {
    const former = new Map(this.#names.map((name, k) => [name, k]));
    const kept = names.map((name) => former.get(name));
    const now = this.tick();
    this.#stamps = Float64Array.from(kept, (k) => (k === undefined ? -1 : this.#stamps[k]));
    this.#changed = Float64Array.from(kept, (k) => (k === undefined ? now : this.#changed[k]));
    this.#static = new Uint8Array(names.length);
    this.#names = names;
  }

  /** The frames' newest stamps; what changed is fresh. */
  take(stamps, known) {
    const now = this.tick();
    for (let k = 0; k < stamps.length; k += 1) {
      this.#static[k] = known[k] && stamps[k] === 0 ? 1 : 0;
      if (stamps[k] === this.#stamps[k]) continue;
      this.#stamps[k] = stamps[k];
      this.#changed[k] = now;
    }
  }

  /** While the view is paused nothing grows older. */
  setPaused(paused) {
    const now = this.#clock();
    if (paused && this.#pausedAt === null) this.#pausedAt = now;
    else if (!paused && this.#pausedAt !== null) {
      this.#paused += now - this.#pausedAt;
      this.#pausedAt = null;
    }
  }

  /** Read the clock, for the calls until the next one; the seconds without pauses. */
  tick() {
    this.#now = (this.#pausedAt ?? this.#clock()) - this.#paused;
    return this.#now;
  }

  /** Seconds since the frame's stamp changed; 0 for a static one. */
  age(k) {
    return this.#static[k] ? 0 : this.#now - this.#changed[k];
  }

  isAlive(k) {
    return this.age(k) <= TIMEOUT_SECONDS;
  }

  /** How grey (0 to 1) a frame is after a third of the time, and how opaque in the last third. */
  fading(k) {
    const third = TIMEOUT_SECONDS / 3;
    const age = this.age(k);
    return {
      grey: Math.min(1, Math.max(0, age / third - 1)),
      alpha: Math.min(1, Math.max(0, 3 - age / third)),
    };
  }

  /** Whether the picture changes with time alone. */
  get isFading() {
    if (this.#pausedAt !== null) return false;
    const first = TIMEOUT_SECONDS / 3;
    for (let k = 0; k < this.#names.length; k += 1) {
      const age = this.age(k);
      if (age > first && age < TIMEOUT_SECONDS + 1) return true;
    }
    return false;
  }
}

const POSE = 7;
const GAP = 1.5;

/**
 * For each root [x, y, z], what is added to the poses of its tree. A tree keeps its place until it
 * would touch another one: `former` are the offsets until now.
 */
export function offsetsOfTrees(frames, former) {
  if (frames.roots.length < 2) return frames.roots.map(() => [0, 0, 0]);
  const boxes = boxesOf(frames);
  const fixed = Math.max(0, frames.trees[frames.index(frames.fixed)] ?? 0);
  const order = [fixed, ...boxes.keys()].filter((tree, at, all) => all.indexOf(tree) === at);
  if (!isUnplaced(former, fixed) && !overlap(boxes, former)) return former;
  const offsets = boxes.map(() => [0, 0, 0]);
  let edge = boxes[fixed].maxX;
  for (const tree of order.slice(1)) {
    const { minX, maxX } = boxes[tree];
    offsets[tree][0] = edge + GAP - minX;
    edge += GAP + maxX - minX;
  }
  return offsets;
}

function boxesOf(frames) {
  const boxes = frames.roots.map(() => ({ minX: -0.5, maxX: 0.5 }));
  for (let k = 0; k < frames.count; k += 1) {
    const box = boxes[frames.trees[k]];
    const x = frames.poses[POSE * k];
    if (!frames.known[k] || !Number.isFinite(x)) continue;
    box.minX = Math.min(box.minX, x);
    box.maxX = Math.max(box.maxX, x);
  }
  return boxes;
}

function isUnplaced(offsets, fixed) {
  return offsets.some(([x], tree) => (tree === fixed) !== (x === 0));
}

function overlap(boxes, offsets) {
  const spans = boxes.map(({ minX, maxX }, k) => [minX + offsets[k][0], maxX + offsets[k][0]]);
  spans.sort(([a], [b]) => a - b);
  return spans.some(([start], k) => k > 0 && start < spans[k - 1][1]);
}

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

/** Frames are hidden by a regular expression, or one by one. */
export class Hiding {
  #pattern = null;
  #chosen = new Map(); // name to hidden or not: stronger than the pattern
  #onChange;

  /** `onChange()`: apply to the frames again. */
  constructor(onChange) {
    this.#onChange = onChange;
    byId("hide").addEventListener("input", ({ target }) => this.#take(target.value));
  }

  /** Hide or show one frame. */
  set(name, hidden) {
    this.#chosen.set(name, hidden);
    this.#onChange();
  }

  /** Write `frames.hidden`. */
  apply(frames) {
    frames.names.forEach((name, k) => {
      frames.hidden[k] = (this.#chosen.get(name) ?? this.#pattern?.test(name) ?? false) ? 1 : 0;
    });
  }

  #take(text) {
    let problem = "";
    try {
      this.#pattern = text ? new RegExp(text) : null;
    } catch (error) {
      problem = `${error.message}.`;
    }
    byId("hide").setAttribute("aria-invalid", String(problem !== ""));
    byId("hide-problem").hidden = problem === "";
    setText(byId("hide-problem"), problem);
    if (!problem) this.#onChange();
  }
}
