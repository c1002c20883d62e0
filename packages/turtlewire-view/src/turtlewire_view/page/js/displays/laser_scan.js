// LaserScan: points, as those of clouds.

import PointCloud from "./point_cloud.js";

export default class LaserScan extends PointCloud {}
