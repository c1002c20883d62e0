// PointStamped: a ball.

import { bytesOf } from "./parts/common.js";
import { Display } from "./parts/display.js";
import { makeBody } from "./parts/solids.js";

export const OPTIONS = [
  { name: "radius", label: "Radius (m)", type: "number", value: 0.2, min: 0.001, step: 0.05 },
  { name: "color", label: "Colour", type: "color", value: "#cc29cc" },
  { name: "alpha", label: "Alpha", type: "number", value: 1, min: 0, max: 1, step: 0.1 },
  { name: "history_length", label: "Points kept", type: "number", value: 1, min: 1, step: 1 },
];

export default class Point extends Display {
  draw(group, { at }) {
    const { radius, color, alpha } = this.options;
    const ball = makeBody("sphere", [2 * radius, 2 * radius, 2 * radius], bytesOf(color, alpha));
    ball.position.fromArray(at);
    group.add(ball);
  }
}
