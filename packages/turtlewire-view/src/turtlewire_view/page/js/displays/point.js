// PointStamped: a ball.

import { bytesOf } from "./parts/common.js";
import { Display } from "./parts/display.js";
import { makeBody } from "./parts/solids.js";

export default class Point extends Display {
  draw(group, { at }) {
    const { radius, color, alpha } = this.options;
    const ball = makeBody("sphere", [2 * radius, 2 * radius, 2 * radius], bytesOf(color, alpha));
    ball.position.fromArray(at);
    group.add(ball);
  }
}
