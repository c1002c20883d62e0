// PolygonStamped: a closed line.

import { bytesOf } from "./parts/common.js";
import { Display } from "./parts/display.js";
import { makeRibbons } from "./parts/ribbons.js";

export default class Polygon extends Display {
  draw(group, _header, { points }) {
    const { color, alpha } = this.options;
    const closed = new Float32Array(points.length + Math.min(3, points.length));
    closed.set(points);
    closed.set(points.subarray(0, 3), points.length);
    group.add(makeRibbons(closed, bytesOf(color), { alpha, least: 2.5 }));
  }
}
