// PointCloud2: points with colours that the server chose.

import { Display } from "./parts/display.js";
import { makePoints } from "./parts/points.js";

export const LOOK_OPTIONS = [
  { name: "size", label: "Size (px)", type: "number", value: 3, min: 1, max: 50, step: 1 },
  {
    name: "size_metres", label: "Size (m), 0: in pixels", type: "number", value: 0, min: 0,
    step: 0.01,
  },
  {
    name: "style", label: "Style", type: "choice", value: "squares",
    choices: ["squares", "discs"],
  },
  { name: "alpha", label: "Alpha", type: "number", value: 1, min: 0, max: 1, step: 0.1 },
];
export const OPTIONS = [
  ...LOOK_OPTIONS,
  {
    name: "color", label: "Coloured by", type: "choice", value: "auto",
    choices: ["auto", "rgb", "intensity", "axis", "flat"],
  },
  { name: "channel", label: "Field of intensity", type: "text", value: "intensity" },
  { name: "axis", label: "Axis", type: "choice", value: "z", choices: ["z", "x", "y"] },
  { name: "flat_color", label: "Flat colour", type: "color", value: "#ffffff" },
  { name: "rainbow", label: "Rainbow", type: "bool", value: true },
  { name: "invert_rainbow", label: "Inverted", type: "bool", value: false },
  { name: "autocompute_bounds", label: "Bounds from the data", type: "bool", value: true },
  { name: "min", label: "Least value", type: "number", value: 0 },
  { name: "max", label: "Greatest value", type: "number", value: 1 },
];

export default class PointCloud extends Display {
  draw(group, _header, { points, rgba }) {
    const { size, size_metres: metres, style, alpha } = this.options;
    const round = style === "discs";
    const look = metres > 0 ? { size: metres, metres: true } : { size };
    const cloud = makePoints(points, rgba, { ...look, alpha, round });
    cloud.frustumCulled = false;
    group.add(cloud);
  }
}
