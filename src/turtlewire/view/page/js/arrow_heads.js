// The heads of many arrows in one draw call: flat triangles that face the camera.

import {
  BufferAttribute, DoubleSide, DynamicDrawUsage, InstancedBufferAttribute, InstancedBufferGeometry,
  Mesh, ShaderMaterial,
} from "three";

const CORNERS = new Float32Array([0, 0, 0, -1, -1, 0, -1, 1, 0]);
const VERTEX = `
attribute vec4 tip;
attribute vec3 along;
attribute vec4 color;
varying vec4 vColor;
void main() {
  vec3 end = (modelViewMatrix * vec4(tip.xyz, 1.0)).xyz;
  vec3 direction = normalize((modelViewMatrix * vec4(along, 0.0)).xyz);
  vec3 sight = projectionMatrix[3][3] == 0.0 ? end : vec3(0.0, 0.0, 1.0);
  vec3 side = cross(direction, sight);
  side = dot(side, side) > 1e-12 ? normalize(side) : vec3(1.0, 0.0, 0.0);
  vec3 at = end + tip.w * (position.x * direction + 0.32 * position.y * side);
  gl_Position = projectionMatrix * vec4(at, 1.0);
  vColor = color;
}`;
const FRAGMENT = `
varying vec4 vColor;
void main() {
  if (vColor.a < 0.02) discard;
  gl_FragColor = vColor;
}`;

export class ArrowHeads {
  object;
  #tips;
  #directions;
  #colors;

  constructor() {
    const material = new ShaderMaterial({
      vertexShader: VERTEX, fragmentShader: FRAGMENT, transparent: true, side: DoubleSide,
    });
    this.object = new Mesh(new InstancedBufferGeometry(), material);
    this.object.frustumCulled = false;
    this.object.renderOrder = 1;
    this.#grow(16);
  }

  /** Room for `count` heads: tips as x, y, z, length; directions; colours as RGBA bytes. */
  reserve(count) {
    if (count > this.#tips.count) this.#grow(Math.ceil(1.5 * count));
    return {
      tips: this.#tips.array, directions: this.#directions.array, colors: this.#colors.array,
    };
  }

  /** Show the first `count` heads of what was reserved. */
  show(count) {
    this.object.geometry.instanceCount = count;
    this.object.visible = count > 0;
    for (const attribute of [this.#tips, this.#directions, this.#colors]) {
      attribute.clearUpdateRanges();
      attribute.addUpdateRange(0, attribute.itemSize * count);
      attribute.needsUpdate = true;
    }
  }

  #grow(count) {
    const attribute = (Kind, size, normalized = false) =>
      new InstancedBufferAttribute(new Kind(size * count), size, normalized)
        .setUsage(DynamicDrawUsage);
    this.#tips = attribute(Float32Array, 4);
    this.#directions = attribute(Float32Array, 3);
    this.#colors = attribute(Uint8Array, 4, true);
    const geometry = new InstancedBufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(CORNERS, 3));
    geometry.setAttribute("tip", this.#tips);
    geometry.setAttribute("along", this.#directions);
    geometry.setAttribute("color", this.#colors);
    geometry.instanceCount = 0;
    this.object.geometry.dispose();
    this.object.geometry = geometry;
  }
}
