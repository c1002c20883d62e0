// GridCells: flat rectangles.

import { bytesOf } from "./parts/common.js";
import { Display } from "./parts/display.js";
import { makeBodies } from "./parts/solids.js";

export default class GridCells extends Display {
  draw(group, { size }, { points }) {
    const { color, alpha } = this.options;
    group.add(makeBodies("box", [...size, 0], points, bytesOf(color), { alpha }));
  }
}
