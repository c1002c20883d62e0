// Range: a cone along x from the sensor to what it sees.

import { ConeGeometry, DoubleSide, Mesh, MeshLambertMaterial } from "three";
import { bytesOf, litColor, opacity } from "./parts/common.js";
import { Display } from "./parts/display.js";

const LEAST_RADIUS = 0.005;

export default class Range extends Display {
  draw(group, { length, angle }) {
    if (length === 0) return;
    const { color, alpha } = this.options;
    const radius = Math.max(LEAST_RADIUS, length * Math.tan(angle / 2));
    const cone = new ConeGeometry(radius, length, 32).rotateZ(Math.PI / 2);
    cone.translate(length / 2, 0, 0);
    const look = { color: litColor(bytesOf(color)), side: DoubleSide, ...opacity(alpha) };
    group.add(new Mesh(cone, new MeshLambertMaterial(look)));
  }
}
