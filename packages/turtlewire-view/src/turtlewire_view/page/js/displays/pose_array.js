// PoseArray: many poses as arrows or axes.

import { bytesOf } from "./parts/common.js";
import { Display } from "./parts/display.js";
import { makeArrows, makeAxes, placesOf } from "./parts/solids.js";

export default class PoseArray extends Display {
  draw(group, _header, { points, rotations }) {
    const { shape, color, alpha, length } = this.options;
    const places = placesOf(points, rotations);
    const size = { shaft: [0.77 * length, 0.04 * length], head: [0.23 * length, 0.15 * length] };
    if (shape === "axes") group.add(makeAxes(places, length, 0.03 * length));
    else {
      const arrows = places.map((place) => ({ ...place, ...size }));
      group.add(makeArrows(arrows, bytesOf(color, alpha)));
    }
  }
}
