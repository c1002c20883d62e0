// Odometry: the last poses, with their covariances.

import { Display } from "./parts/display.js";
import { makePose } from "./parts/pose_shape.js";

export default class Odometry extends Display {
  draw(group, header) {
    group.add(makePose(header, this.options));
  }
}
