// PointCloud2: points with colours that the server chose.

import { clear } from "./parts/common.js";
import { Display } from "./parts/display.js";
import { makePoints } from "./parts/points.js";
import { makeBodies } from "./parts/solids.js";

/** Styles whose points are bodies: their shape, and their size as a multiple of the chosen one. */
const BODIES = { boxes: ["box", [1, 1, 1]], tiles: ["box", [1, 1, 0]] };

export default class PointCloud extends Display {
  #timers = new Map(); // part to what ends it after its decay time

  draw(group, _header, { points, rgba }) {
    const { size, size_metres: metres, style, alpha } = this.options;
    if (BODIES[style]) {
      const [shape, factors] = BODIES[style];
      group.add(makeBodies(shape, factors.map((each) => each * metres), points, rgba, alpha));
      return;
    }
    const look = style === "points" ? { size } : { size: metres, metres: true };
    const cloud = makePoints(points, rgba, { ...look, alpha, round: style === "spheres" });
    cloud.frustumCulled = false;
    group.add(cloud);
  }

  show(group, header, arrays) {
    super.show(group, header, arrays);
    this.#stop(header.part);
    if (!header.decay) return;
    this.#timers.set(header.part, setTimeout(() => {
      this.removed(header.part);
      clear(group);
      this.view.requestDraw();
    }, 1000 * header.decay));
  }

  removed(part) {
    super.removed(part);
    this.#stop(part);
  }

  dispose() {
    for (const part of [...this.#timers.keys()]) this.#stop(part);
  }

  #stop(part) {
    clearTimeout(this.#timers.get(part));
    this.#timers.delete(part);
  }
}
