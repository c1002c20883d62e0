// Clouds of points with colours that the server chose.

import { clear, Display } from "./parts/common.js";
import { makePoints } from "./parts/points.js";
import { makeBodies } from "./parts/solids.js";

/** Styles whose points are bodies: their shape, and their size as a multiple of the chosen one. */
const BODIES = { boxes: ["box", [1, 1, 1]], tiles: ["box", [1, 1, 0]] };

/** PointCloud2, PointCloud and LaserScan. */
export class PointCloud extends Display {
  #timers = new Map(); // part to what ends it after its decay time

  draw(group, header, { points, rgba }) {
    const { size, style, alpha } = this.options;
    const [metres, perDepth] = this.sizeOf(header);
    if (BODIES[style]) {
      const [shape, factors] = BODIES[style];
      const sides = factors.map((each) => each * metres);
      group.add(makeBodies(shape, sides, points, rgba, { alpha, perDepth }));
      return;
    }
    const look = style === "points" ? { size } : { size: metres, metres: true, perDepth };
    const cloud = makePoints(points, rgba, { ...look, alpha, round: style === "spheres" });
    cloud.frustumCulled = false;
    group.add(cloud);
  }

  /** The size of a point [m], and whether it is the one at a distance of 1 m. */
  sizeOf() {
    return [this.options.size_metres, false];
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

/** A depth image as points, each as wide as its pixel unless the user chooses a size. */
export class DepthCloud extends PointCloud {
  sizeOf({ pixel }) {
    const { auto_size: isAutomatic, auto_size_factor: factor, size_metres: metres } = this.options;
    return isAutomatic ? [pixel * factor, true] : [metres, false];
  }
}
