// LaserScan: points, as those of clouds.

import PointCloud, { LOOK_OPTIONS } from "./point_cloud.js";

export const OPTIONS = [
  ...LOOK_OPTIONS,
  {
    name: "color", label: "Coloured by", type: "choice", value: "auto",
    choices: ["auto", "intensity", "flat"],
  },
  { name: "flat_color", label: "Flat colour", type: "color", value: "#ff3c28" },
];

export default class LaserScan extends PointCloud {}
