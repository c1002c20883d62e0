// Where trees that are not connected with the fixed frame stand: in a row beside it.

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
  let edge = -boxes[fixed].maxY;
  for (const tree of order) {
    const { minY, maxY } = boxes[tree];
    const width = Math.max(1, maxY - minY);
    if (tree !== fixed) offsets[tree][1] = -(edge + GAP) - maxY;
    edge += width + (tree === fixed ? 0 : GAP);
  }
  return offsets;
}

function boxesOf(frames) {
  const boxes = frames.roots.map(() => ({ minX: -0.5, maxX: 0.5, minY: -0.5, maxY: 0.5 }));
  for (let k = 0; k < frames.count; k += 1) {
    const box = boxes[frames.trees[k]];
    const [x, y] = [frames.poses[POSE * k], frames.poses[POSE * k + 1]];
    if (!frames.known[k] || !Number.isFinite(x + y)) continue;
    box.minX = Math.min(box.minX, x);
    box.maxX = Math.max(box.maxX, x);
    box.minY = Math.min(box.minY, y);
    box.maxY = Math.max(box.maxY, y);
  }
  return boxes;
}

function isUnplaced(offsets, fixed) {
  return offsets.some(([, y], tree) => (tree === fixed) !== (y === 0));
}

function overlap(boxes, offsets) {
  const spans = boxes.map(({ minY, maxY }, k) => [minY + offsets[k][1], maxY + offsets[k][1]]);
  spans.sort(([a], [b]) => a - b);
  return spans.some(([start], k) => k > 0 && start < spans[k - 1][1]);
}
