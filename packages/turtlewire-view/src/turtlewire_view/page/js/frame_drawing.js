// All frames in three draw calls: axes, arrows from child to parent, and what is highlighted.
// The heads of many arrows in one draw call: flat triangles that face the camera.

import {
  BufferAttribute, BufferGeometry, DoubleSide, DynamicDrawUsage, Group, Mesh, NoBlending,
  NormalBlending, ShaderMaterial,
} from "three";

import { bytesOf } from "./colors.js";
import { ThickLines } from "./thick_lines.js";

const CORNERS = [0, 0, 0, -1, -1, 0, -1, 1, 0];
const VERTEX = `
attribute vec4 tip;
attribute vec3 along;
attribute vec4 color;
flat varying vec4 vColor;
void main() {
  vec3 end = (modelViewMatrix * vec4(tip.xyz, 1.0)).xyz;
  vec3 direction = normalize((modelViewMatrix * vec4(along, 0.0)).xyz);
  vec3 sight = projectionMatrix[3][3] == 0.0 ? end : vec3(0.0, 0.0, 1.0);
  vec3 side = cross(direction, sight);
  side = dot(side, side) > 1e-12 ? normalize(side) : vec3(1.0, 0.0, 0.0);
  vec3 at = end + tip.w * (position.x * direction + 0.32 * position.y * side);
  gl_Position = projectionMatrix * vec4(at, 1.0);
  if (color.a < 0.02) gl_Position = vec4(0.0);
  vColor = color;
}`;
const FRAGMENT = `
flat varying vec4 vColor;
void main() {
  gl_FragColor = vColor;
}`;

export class ArrowHeads {
  object;
  #tips;
  #directions;
  #colors;

  /** Heads `onTop` are seen through everything. */
  constructor({ onTop = false } = {}) {
    const material = new ShaderMaterial({
      vertexShader: VERTEX, fragmentShader: FRAGMENT, transparent: true, side: DoubleSide,
      depthTest: !onTop,
    });
    this.object = new Mesh(new BufferGeometry(), material);
    this.object.frustumCulled = false;
    this.object.renderOrder = onTop ? 5 : 1;
    this.#grow(16);
  }

  /** Room for `count` heads. */
  reserve(count) {
    if (3 * count > this.#tips.count) this.#grow(Math.ceil(1.5 * count));
  }

  /** Head `k`: its tip, how long it is [m], the direction that it points to, RGBA in bytes. */
  set(k, [x, y, z], length, direction, color) {
    for (let corner = 3 * k; corner < 3 * k + 3; corner += 1) {
      this.#tips.setXYZW(corner, x, y, z, length);
      this.#directions.setXYZ(corner, ...direction);
      this.#colors.array.set(color, 4 * corner);
    }
  }

  /** Show the first `count` heads; `opaque` ones cover what is behind. */
  show(count, { opaque = false } = {}) {
    this.object.material.blending = opaque ? NoBlending : NormalBlending;
    this.object.geometry.setDrawRange(0, 3 * count);
    this.object.visible = count > 0;
    for (const attribute of [this.#tips, this.#directions, this.#colors]) {
      attribute.clearUpdateRanges();
      attribute.addUpdateRange(0, attribute.itemSize * 3 * count);
      attribute.needsUpdate = true;
    }
  }

  /** Three corners for each head. Not instanced: that is slow on a processor. */
  #grow(count) {
    const attribute = (Kind, size, normalized = false) =>
      new BufferAttribute(new Kind(3 * size * count), size, normalized).setUsage(DynamicDrawUsage);
    this.#tips = attribute(Float32Array, 4);
    this.#directions = attribute(Float32Array, 3);
    this.#colors = attribute(Uint8Array, 4, true);
    const corners = new Int8Array(9 * count);
    for (let k = 0; k < count; k += 1) corners.set(CORNERS, 9 * k);
    this.object.geometry.dispose();
    this.object.geometry = new BufferGeometry()
      .setAttribute("position", new BufferAttribute(corners, 3))
      .setAttribute("tip", this.#tips)
      .setAttribute("along", this.#directions)
      .setAttribute("color", this.#colors);
  }
}

const POSE = 7;
const NEAR_METRES = 0.001; // a shorter arrow is not drawn, as in RViz
const DIM = 0.3;

export class FrameDrawing {
  object = new Group();
  /** Length of the axes [m]. */
  size = 0.2;
  show = { axes: true, arrows: true };
  #axes = new ThickLines(2.5, { plain: true });
  #shafts = new ThickLines(1.5, { plain: true });
  #heads = new ArrowHeads();
  #path = new ThickLines(5, { onTop: true });
  #straight = new ThickLines(1.5, { onTop: true });
  #straightHead = new ArrowHeads({ onTop: true });
  #colors;

  constructor(colors) {
    this.setColors(colors);
    const parts = [this.#axes, this.#shafts, this.#heads, this.#path, this.#straight];
    this.object.add(...parts.map(({ object }) => object), this.#straightHead.object);
  }

  setColors(colors) {
    const names = ["x", "y", "z", "head", "shaft", "faded", "accent"];
    this.#colors = Object.fromEntries(names.map((name) => [name, bytesOf(colors[name])]));
  }

  /** Rewrite everything. `path`: indices of highlighted frames in order, perhaps none. */
  update(frames, path) {
    frames.ages.tick();
    const onPath = new Set(path);
    const dim = (k) => (path.length > 0 && !onPath.has(k) ? DIM : 1);
    const opaque = path.length === 0 && !frames.ages.isFading;
    this.#drawAxes(frames, dim, opaque);
    this.#drawArrows(frames, dim, opaque);
    this.#drawPath(frames, path);
    this.#drawStraight(frames, path);
  }

  #drawAxes(frames, dim, opaque) {
    const { ends, colors } = this.#axes.reserve(3 * frames.count);
    const kinds = [this.#colors.x, this.#colors.y, this.#colors.z];
    const at = [0, 0, 0];
    let count = 0;
    for (let k = 0; this.show.axes && k < frames.count; k += 1) {
      if (!frames.isShown(k)) continue;
      frames.position(k, at);
      writeAxes(frames.poses, POSE * k, at, this.size, ends, 6 * count);
      const fading = frames.ages.fading(k);
      const alpha = 255 * fading.alpha * dim(k);
      for (let axis = 0; axis < 3; axis += 1) {
        this.#write(colors, 8 * (count + axis), kinds[axis], fading.grey, alpha);
      }
      count += 3;
    }
    this.#axes.show(count, { opaque });
  }

  #drawArrows(frames, dim, opaque) {
    const shafts = this.#shafts.reserve(frames.count);
    this.#heads.reserve(frames.count);
    const color = [0, 0, 0, 0];
    const [from, to] = [[0, 0, 0], [0, 0, 0]];
    let count = 0;
    for (let k = 0; this.show.arrows && k < frames.count; k += 1) {
      const parent = frames.parents[k];
      if (parent < 0 || !frames.isShown(k) || !frames.isShown(parent)) continue;
      frames.position(k, from);
      frames.position(parent, to);
      const [x, y, z] = [to[0] - from[0], to[1] - from[1], to[2] - from[2]];
      const length = Math.hypot(x, y, z);
      if (!(length >= NEAR_METRES)) continue;
      const head = Math.min(0.55 * this.size, 0.4 * length);
      const back = head / length;
      shafts.ends.set(from, 6 * count);
      shafts.ends.set([to[0] - back * x, to[1] - back * y, to[2] - back * z], 6 * count + 3);
      const { grey, alpha } = frames.ages.fading(k);
      const opacity = 255 * alpha * dim(k) * Math.min(dim(parent), 1);
      this.#write(shafts.colors, 8 * count, this.#colors.shaft, grey, opacity);
      this.#write(color, 0, this.#colors.head, grey, opacity, 1);
      this.#heads.set(count, to, head, [x, y, z], color);
      count += 1;
    }
    this.#shafts.show(count, { opaque });
    this.#heads.show(count, { opaque });
  }

  #drawPath(frames, path) {
    const { ends, colors } = this.#path.reserve(path.length);
    let count = 0;
    for (let k = 1; k < path.length; k += 1) {
      if (!frames.isShown(path[k - 1]) || !frames.isShown(path[k])) continue;
      ends.set(frames.position(path[k - 1]), 6 * count);
      ends.set(frames.position(path[k]), 6 * count + 3);
      this.#write(colors, 8 * count, this.#colors.accent, 0, 220);
      count += 1;
    }
    this.#path.show(count);
  }

  /** The arrow from the last frame of the path to the first, as in the relation panel. */
  #drawStraight(frames, path) {
    const [source, target] = [path[0], path.at(-1)];
    const isShown = path.length > 2 && frames.isShown(source) && frames.isShown(target);
    const { ends, colors } = this.#straight.reserve(1);
    if (isShown) {
      const [from, to] = [frames.position(target), frames.position(source)];
      const along = to.map((value, i) => value - from[i]);
      ends.set([...from, ...to]);
      this.#write(colors, 0, this.#colors.accent, 0, 255);
      const head = Math.min(0.55 * this.size, 0.4 * Math.hypot(...along));
      this.#straightHead.reserve(1);
      this.#straightHead.set(0, to, head, along, [...this.#colors.accent, 255]);
    }
    this.#straight.show(isShown ? 1 : 0);
    this.#straightHead.show(isShown ? 1 : 0);
  }

  /** A colour, on its way to grey, into `ends` vertices from `at` on. */
  #write(colors, at, color, grey, alpha, ends = 2) {
    for (let end = 0; end < ends; end += 1) {
      for (let i = 0; i < 3; i += 1) {
        colors[at + 4 * end + i] = color[i] + grey * (this.#colors.faded[i] - color[i]);
      }
      colors[at + 4 * end + 3] = alpha;
    }
  }
}

/** Three segments from `origin` along the axes of the rotation at `poses[start + 3]`. */
function writeAxes(poses, start, origin, size, ends, at) {
  const [x, y, z, w] = [poses[start + 3], poses[start + 4], poses[start + 5], poses[start + 6]];
  const axes = [
    1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w),
    2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w),
    2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y),
  ];
  for (let axis = 0; axis < 3; axis += 1) {
    for (let i = 0; i < 3; i += 1) {
      ends[at + 6 * axis + i] = origin[i];
      ends[at + 6 * axis + 3 + i] = origin[i] + size * axes[3 * axis + i];
    }
  }
}
