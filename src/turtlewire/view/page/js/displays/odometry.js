// Odometry: the last poses, with their covariances.

import { Display } from "./parts/display.js";
import { makePose, POSE_OPTIONS } from "./parts/pose_shape.js";

export const OPTIONS = [
  ...POSE_OPTIONS,
  { name: "keep", label: "Poses kept", type: "number", value: 100, min: 1, step: 1 },
  {
    name: "position_tolerance", label: "Position tolerance (m)", type: "number", value: 0.1,
    min: 0, step: 0.1,
  },
  {
    name: "angle_tolerance", label: "Angle tolerance (rad)", type: "number", value: 0.1,
    min: 0, step: 0.1,
  },
];

export default class Odometry extends Display {
  draw(group, header) {
    group.add(makePose(header, this.options));
  }
}
