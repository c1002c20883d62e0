// PolygonStamped: a closed line.

import { bytesOf } from "./parts/common.js";
import { Display } from "./parts/display.js";
import { makeRibbons } from "./parts/ribbons.js";

export const OPTIONS = [
  { name: "color", label: "Colour", type: "color", value: "#19ff00" },
  { name: "alpha", label: "Alpha", type: "number", value: 1, min: 0, max: 1, step: 0.1 },
];

export default class Polygon extends Display {
  draw(group, _header, { points }) {
    const { color, alpha } = this.options;
    const closed = new Float32Array(points.length + Math.min(3, points.length));
    closed.set(points);
    closed.set(points.subarray(0, 3), points.length);
    group.add(makeRibbons(closed, bytesOf(color), { alpha, least: 2.5 }));
  }
}
