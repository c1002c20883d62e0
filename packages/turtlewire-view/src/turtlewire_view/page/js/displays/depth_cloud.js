// A depth image as points, each as wide as its pixel unless the user chooses a size.

import PointCloud from "./point_cloud.js";

export default class DepthCloud extends PointCloud {
  sizeOf({ pixel }) {
    const { auto_size: isAutomatic, auto_size_factor: factor, size_metres: metres } = this.options;
    return isAutomatic ? [pixel * factor, true] : [metres, false];
  }
}
