// How large the scene is, and which sizes fit it.

import { Vector3 } from "three";

/** Middle and radius [m] of all shown frames; null when there is none. */
export function extentOf(frames) {
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  const at = [0, 0, 0];
  for (let k = 0; k < frames.count; k += 1) {
    if (!frames.isShown(k)) continue;
    frames.position(k, at);
    for (let i = 0; i < 3; i += 1) {
      low[i] = Math.min(low[i], at[i]);
      high[i] = Math.max(high[i], at[i]);
    }
  }
  if (!Number.isFinite(low[0])) return null;
  const middle = new Vector3(...low.map((value, i) => (value + high[i]) / 2));
  return { middle, radius: Math.max(0.1, new Vector3(...high).sub(middle).length()) };
}

/** Length of the axes [m] for a scene of that radius: a part of a usual link, but never tiny. */
export function sizeFor(frames, radius) {
  const lengths = [];
  for (let k = 0; k < frames.count; k += 1) {
    if (frames.parents[k] < 0 || !frames.isShown(k)) continue;
    const [x, y, z] = frames.position(k);
    const [px, py, pz] = frames.position(frames.parents[k]);
    const length = Math.hypot(x - px, y - py, z - pz);
    if (length > 0.001) lengths.push(length);
  }
  lengths.sort((a, b) => a - b);
  const usual = 0.4 * (lengths[lengths.length >> 1] ?? radius);
  const room = (1.5 * radius) / Math.sqrt(lengths.length + 1); // a crowd needs small ones
  return nice(Math.min(0.16 * radius, room, Math.max(0.03 * radius, usual)));
}

/** Side of the grid's squares [m] for a scene of that radius. */
export function cellFor(radius) {
  return nice(radius / 5);
}

/** The nearest of … 0.1, 0.2, 0.5, 1, 2, 5 … */
export function nice(value) {
  const power = 10 ** Math.floor(Math.log10(value));
  const steps = [1, 2, 5, 10].map((step) => step * power);
  const away = (step) => Math.abs(Math.log(step / value));
  const best = steps.reduce((a, b) => (away(b) < away(a) ? b : a));
  return Number(best.toPrecision(3));
}
