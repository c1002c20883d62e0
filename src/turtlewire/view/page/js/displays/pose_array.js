// PoseArray: many poses as arrows or axes.

import { bytesOf } from "./parts/common.js";
import { Display } from "./parts/display.js";
import { makeArrows, makeAxes, placesOf } from "./parts/solids.js";

export const OPTIONS = [
  { name: "shape", label: "Shape", type: "choice", value: "arrow", choices: ["arrow", "axes"] },
  { name: "color", label: "Colour", type: "color", value: "#ff1900" },
  { name: "alpha", label: "Alpha", type: "number", value: 1, min: 0, max: 1, step: 0.1 },
  { name: "length", label: "Length (m)", type: "number", value: 0.3, min: 0.01, step: 0.1 },
];

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
