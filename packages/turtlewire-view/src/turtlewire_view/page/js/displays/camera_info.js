// CameraInfo: the pyramid that a camera sees, along z.

import { BufferAttribute, BufferGeometry, DoubleSide, Mesh, MeshBasicMaterial } from "three";
import { bytesOf, litColor, opacity } from "./parts/common.js";
import { Display } from "./parts/display.js";
import { makeRibbons } from "./parts/ribbons.js";

export default class CameraInfo extends Display {
  draw(group, { corners }) {
    const { far, color, alpha, edge_color: edges, show_edges: hasEdges } = this.options;
    const ends = corners.map(([x, y]) => [x * far, y * far, far]);
    const sides = ends.map((end, k) => [end, ends[(k + 1) % ends.length]]);
    if (this.options.show_polygons) {
      const places = new Float32Array(sides.flatMap((side) => [0, 0, 0, ...side.flat()]));
      const geometry = new BufferGeometry();
      geometry.setAttribute("position", new BufferAttribute(places, 3));
      const look = { color: litColor(bytesOf(color)), side: DoubleSide, ...opacity(alpha) };
      group.add(new Mesh(geometry, new MeshBasicMaterial({ ...look, depthWrite: false })));
    }
    if (!hasEdges) return;
    const lines = sides.flatMap(([from, to]) => [0, 0, 0, ...from, ...from, ...to]);
    group.add(makeRibbons(new Float32Array(lines), bytesOf(edges), { pairs: true, alpha }));
  }
}
