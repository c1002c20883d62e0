// How large the scene is, and which sizes fit it.

import { Box3, Vector3 } from "three";

const APART = 30; // times as far from the middle as most frames are: not looked at first
const FARTHEST = 1e7; // [m]
const SURROUNDINGS = 100; // so far away a display belongs to even the smallest robot [m]

/** Box, middle and radius [m] of all shown frames and what is visible below `displays`; or null. */
export function extentOf(frames, displays = null) {
  const box = new Box3().setFromPoints(placesOf(frames));
  if (displays) addObjects(displays, box);
  return box.isEmpty() ? null : { ...roundOf(box), isApart: false };
}

/**
 * As `extentOf`, without the few frames that are very far from all others, as a map's origin may
 * be from its robot, and without what displays show so far away; `isApart` says whether there are
 * such frames.
 */
export function crowdOf(frames, displays) {
  const places = placesOf(frames);
  if (!places.length) return null;
  const along = (axis) => median(places.map((at) => at[axis]));
  const middle = new Vector3(along("x"), along("y"), along("z"));
  const away = places.map((place) => place.distanceTo(middle));
  const most = [...away].sort((a, b) => a - b)[Math.floor(0.7 * away.length)];
  const limit = Math.max(0.1, APART * most);
  const near = places.filter((_, k) => away[k] <= limit);
  const box = new Box3().setFromPoints(near);
  const { middle: centre, radius } = roundOf(box);
  addObjects(displays, box, centre, Math.max(SURROUNDINGS, APART * radius));
  return { ...roundOf(box), isApart: near.length < places.length };
}

function placesOf(frames) {
  const found = [];
  for (let k = 0; k < frames.count; k += 1) {
    if (frames.isShown(k)) found.push(new Vector3(...frames.position(k)));
  }
  return found;
}

function roundOf(box) {
  const middle = box.getCenter(new Vector3());
  return { box, middle, radius: Math.max(0.1, middle.distanceTo(box.max)) };
}

function median(values) {
  return values.sort((a, b) => a - b)[values.length >> 1];
}

/** Let a box hold all that is visible below an object and within `farthest` [m] of `middle`. */
function addObjects(object, box, middle = new Vector3(), farthest = FARTHEST) {
  if (!object.visible) return;
  if (object.geometry) {
    object.updateWorldMatrix(true, false);
    const own = boxOf(object).clone().applyMatrix4(object.matrixWorld);
    if ([own.min, own.max].every((end) => end.distanceTo(middle) < farthest)) box.union(own);
  }
  for (const child of object.children) addObjects(child, box, middle, farthest);
}

function boxOf(object) {
  const { start, end } = object.geometry.attributes;
  if (start && end) { // ribbons: their positions are corners of each segment
    const ends = [start, end].map((places) => new Box3().setFromBufferAttribute(places));
    return ends[0].union(ends[1]);
  }
  const holder = object.isInstancedMesh ? object : object.geometry;
  holder.computeBoundingBox();
  return holder.boundingBox;
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
