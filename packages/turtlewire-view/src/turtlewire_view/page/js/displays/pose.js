// PoseStamped and PoseWithCovarianceStamped.

import { Display } from "./parts/display.js";
import { makePose } from "./parts/pose_shape.js";

export default class Pose extends Display {
  draw(group, header) {
    group.add(makePose(header, this.options));
  }
}
