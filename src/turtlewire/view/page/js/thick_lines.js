// Many straight segments in one draw call, some pixels wide, with a colour at each end.

import {
  DynamicDrawUsage, InstancedBufferGeometry, InstancedInterleavedBuffer,
  InterleavedBufferAttribute, Mesh, ShaderMaterial, BufferAttribute, Vector2,
} from "three";

const CORNERS = new Float32Array([0, -1, 0, 0, 1, 0, 1, 1, 0, 1, -1, 0]);
const VERTEX = `
attribute vec3 start;
attribute vec3 end;
attribute vec4 startColor;
attribute vec4 endColor;
uniform vec2 viewport;
uniform float width;
uniform float near;
varying vec4 vColor;
varying float vSide;
void main() {
  vec4 a = modelViewMatrix * vec4(start, 1.0);
  vec4 b = modelViewMatrix * vec4(end, 1.0);
  if (a.z > -near && b.z < -near) a = mix(b, a, (b.z + near) / (b.z - a.z));
  else if (b.z > -near && a.z < -near) b = mix(a, b, (a.z + near) / (a.z - b.z));
  vec4 p = projectionMatrix * a;
  vec4 q = projectionMatrix * b;
  vec2 along = (q.xy / q.w - p.xy / p.w) * viewport;
  along = dot(along, along) > 1e-8 ? normalize(along) : vec2(1.0, 0.0);
  vec4 at = position.x < 0.5 ? p : q;
  at.xy += vec2(-along.y, along.x) * position.y * (width + 1.0) / viewport * at.w;
  gl_Position = at;
  vColor = position.x < 0.5 ? startColor : endColor;
  vSide = position.y * (width + 1.0) * 0.5;
}`;
const FRAGMENT = `
uniform float width;
varying vec4 vColor;
varying float vSide;
void main() {
  float alpha = vColor.a * clamp(width * 0.5 + 0.5 - abs(vSide), 0.0, 1.0);
  if (alpha < 0.02) discard;
  gl_FragColor = vec4(vColor.rgb, alpha);
}`;

export class ThickLines {
  object;
  #ends;
  #colors;

  /** `width` [CSS pixels]; lines with `onTop` are seen through everything. */
  constructor(width, { onTop = false } = {}) {
    const material = new ShaderMaterial({
      vertexShader: VERTEX,
      fragmentShader: FRAGMENT,
      uniforms: {
        viewport: { value: new Vector2(1, 1) }, width: { value: width }, near: { value: 0.01 },
      },
      transparent: true,
      depthTest: !onTop,
    });
    this.object = new Mesh(new InstancedBufferGeometry(), material);
    this.object.frustumCulled = false;
    this.object.renderOrder = onTop ? 5 : 1;
    this.object.onBeforeRender = (renderer, scene, camera) => {
      renderer.getSize(material.uniforms.viewport.value);
      material.uniforms.near.value = camera.near;
    };
    this.#grow(16);
  }

  /** Room for `count` segments: x, y, z of both ends; and their colours as RGBA bytes. */
  reserve(count) {
    if (6 * count > this.#ends.array.length) this.#grow(Math.ceil(1.5 * count));
    return { ends: this.#ends.array, colors: this.#colors.array };
  }

  /** Show the first `count` segments of what was reserved. */
  show(count) {
    this.object.geometry.instanceCount = count;
    this.object.visible = count > 0;
    for (const [buffer, size] of [[this.#ends, 6], [this.#colors, 8]]) {
      buffer.clearUpdateRanges();
      buffer.addUpdateRange(0, size * count);
      buffer.needsUpdate = true;
    }
  }

  dispose() {
    this.object.geometry.dispose();
    this.object.material.dispose();
  }

  #grow(count) {
    const ends = new Float32Array(6 * count);
    const colors = new Uint8Array(8 * count);
    if (this.#ends) ends.set(this.#ends.array);
    if (this.#colors) colors.set(this.#colors.array);
    this.#ends = new InstancedInterleavedBuffer(ends, 6).setUsage(DynamicDrawUsage);
    this.#colors = new InstancedInterleavedBuffer(colors, 8).setUsage(DynamicDrawUsage);
    const geometry = new InstancedBufferGeometry();
    geometry.setIndex([0, 2, 1, 0, 3, 2]);
    geometry.setAttribute("position", new BufferAttribute(CORNERS, 3));
    geometry.setAttribute("start", new InterleavedBufferAttribute(this.#ends, 3, 0));
    geometry.setAttribute("end", new InterleavedBufferAttribute(this.#ends, 3, 3));
    geometry.setAttribute("startColor", new InterleavedBufferAttribute(this.#colors, 4, 0, true));
    geometry.setAttribute("endColor", new InterleavedBufferAttribute(this.#colors, 4, 4, true));
    geometry.instanceCount = 0;
    this.object.geometry.dispose();
    this.object.geometry = geometry;
  }
}
