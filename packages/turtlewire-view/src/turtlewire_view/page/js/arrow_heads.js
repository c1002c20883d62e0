// The heads of many arrows in one draw call: flat triangles that face the camera.

import {
  BufferAttribute, BufferGeometry, DoubleSide, DynamicDrawUsage, Mesh, NoBlending, NormalBlending,
  ShaderMaterial,
} from "three";

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
