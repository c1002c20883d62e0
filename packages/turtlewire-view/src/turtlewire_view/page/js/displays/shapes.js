// One shape at a frame: points, polygons, grid cells, ranges, cameras, and sensor values.

import {
  BufferAttribute, BufferGeometry, ConeGeometry, DoubleSide, Mesh, MeshBasicMaterial,
  MeshLambertMaterial,
} from "three";

import { bytesOf, Display, litColor, opacity } from "./parts/common.js";
import { makeRibbons } from "./parts/ribbons.js";
import { makeBodies, makeBody } from "./parts/solids.js";
import { makeText } from "./parts/text.js";

const LEAST_RADIUS = 0.005;

/** A ball. */
export class Point extends Display {
  draw(group, { at }) {
    const { radius, color, alpha } = this.options;
    const ball = makeBody("sphere", [2 * radius, 2 * radius, 2 * radius], bytesOf(color, alpha));
    ball.position.fromArray(at);
    group.add(ball);
  }
}

/** A closed line. */
export class Polygon extends Display {
  draw(group, _header, { points }) {
    const { color, alpha } = this.options;
    const closed = new Float32Array(points.length + Math.min(3, points.length));
    closed.set(points);
    closed.set(points.subarray(0, 3), points.length);
    group.add(makeRibbons(closed, bytesOf(color), { alpha, least: 2.5 }));
  }
}

/** Flat rectangles. */
export class GridCells extends Display {
  draw(group, { size }, { points }) {
    const { color, alpha } = this.options;
    group.add(makeBodies("box", [...size, 0], points, bytesOf(color), { alpha }));
  }
}

/** A cone along x from the sensor to what it sees. */
export class Range extends Display {
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

/** The pyramid that a camera sees, along z. */
export class CameraInfo extends Display {
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

/** A ball, and the number above it. */
export class Measurement extends Display {
  draw(group, { text, color }) {
    const { size, alpha, text_size: height, text_color: ink } = this.options;
    group.add(makeBody("sphere", [size, size, size], [...color.slice(0, 3), 255 * alpha]));
    if (height === 0) return;
    const label = makeText(text, height, bytesOf(ink));
    label.position.set(0, 0, size / 2 + height);
    group.add(label);
  }
}
