// Places trees that are not connected to the fixed frame in a row next to it.

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
