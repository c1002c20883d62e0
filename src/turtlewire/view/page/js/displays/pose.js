// PoseStamped and PoseWithCovarianceStamped.

import { Display } from "./parts/display.js";
import { makePose, POSE_OPTIONS } from "./parts/pose_shape.js";

export const OPTIONS = POSE_OPTIONS;

export default class Pose extends Display {
  draw(group, header) {
    group.add(makePose(header, this.options));
  }
}
