// Path: a line, and its poses as axes or arrows.

import { bytesOf } from "./parts/common.js";
import { Display } from "./parts/display.js";
import { makeRibbons } from "./parts/ribbons.js";
import { makeArrows, makeAxes, placesOf } from "./parts/solids.js";

const ARROW = { shaft: [0.1, 0.1], head: [0.2, 0.3] };
const ARROW_COLOR = bytesOf("#ff55ff");

export default class Path extends Display {
  draw(group, _header, { points, rotations }) {
    const { color, width, alpha, pose_style: style } = this.options;
    group.add(makeRibbons(points, bytesOf(color), { width, alpha }));
    if (!rotations || style === "none") return;
    const places = placesOf(points, rotations);
    if (style === "axes") group.add(makeAxes(places, 0.3, 0.03));
    else group.add(makeArrows(places.map((place) => ({ ...place, ...ARROW })), ARROW_COLOR));
  }
}
