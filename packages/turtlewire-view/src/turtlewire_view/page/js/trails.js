// Where chosen frames were lately, as lines that fade.

import { Group } from "three";
import { bytesOf, colorOfName } from "./colors.js";
import { ThickLines } from "./thick_lines.js";

const MOST_POINTS = 600;
const STEP_METRES = 0.005;
const JUMP_METRES = 5; // a teleport, or another time of a bag: no line

export class Trails {
  object = new Group();
  #trails = new Map(); // name to { points, lines, color }

  /** Names of the frames with a trail. */
  get names() {
    return [...this.#trails.keys()];
  }

  has(name) {
    return this.#trails.has(name);
  }

  /** How many points the trail of a frame has. */
  lengthOf(name) {
    return this.#trails.get(name)?.points.length ?? 0;
  }

  /** Begin or end the trail of a frame. */
  toggle(name) {
    const trail = this.#trails.get(name);
    if (trail) {
      this.object.remove(trail.lines.object);
      trail.lines.dispose();
      this.#trails.delete(name);
      return;
    }
    const lines = new ThickLines(2);
    lines.show(0);
    this.object.add(lines.object);
    this.#trails.set(name, { points: [], lines, color: bytesOf(colorOfName(name)) });
  }

  /** Forget the points: another fixed frame, another time. */
  clear() {
    for (const { points, lines } of this.#trails.values()) {
      points.length = 0;
      lines.show(0);
    }
  }

  /** Take the frames' places after each packet. */
  take(frames) {
    for (const [name, trail] of this.#trails) {
      const k = frames.index(name);
      if (k < 0 || !frames.known[k]) continue;
      const point = frames.position(k);
      const last = trail.points.at(-1);
      if (last && distance(last, point) < STEP_METRES) continue;
      trail.points.push(point);
      if (trail.points.length > MOST_POINTS) trail.points.shift();
      draw(trail);
    }
  }
}

function draw({ points, lines, color }) {
  const { ends, colors } = lines.reserve(points.length);
  let count = 0;
  for (let k = 1; k < points.length; k += 1) {
    if (distance(points[k - 1], points[k]) > JUMP_METRES) continue;
    ends.set(points[k - 1], 6 * count);
    ends.set(points[k], 6 * count + 3);
    const alphas = [k - 1, k].map((at) => (230 * (MOST_POINTS - points.length + at)) / MOST_POINTS);
    colors.set([...color, alphas[0], ...color, alphas[1]], 8 * count);
    count += 1;
  }
  lines.show(count);
}

function distance(a, b) {
  return Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}
