// Many straight segments in one draw call, some pixels wide, with a colour at each end.
//
// Without a graphics card wide lines are slow: there many segments are drawn one pixel wide.

import {
  BufferAttribute, BufferGeometry, DynamicDrawUsage, Group, InterleavedBuffer,
  InterleavedBufferAttribute, LineSegments, Mesh, NoBlending, NormalBlending, ShaderMaterial,
  Vector2,
} from "three";

const MOST_WIDE = 400; // segments, where a processor draws
const CORNERS = [0, -1, 0, 0, 1, 0, 1, 1, 0, 1, -1, 0];
const TRIANGLES = [0, 2, 1, 0, 3, 2];
const WIDE_VERTEX = `
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
const WIDE_FRAGMENT = `
uniform float width;
varying vec4 vColor;
varying float vSide;
void main() {
  float alpha = vColor.a * clamp(width * 0.5 + 0.5 - abs(vSide), 0.0, 1.0);
  if (alpha < 0.02) discard;
  gl_FragColor = vec4(vColor.rgb, alpha);
}`;
const THIN_VERTEX = `
attribute vec4 color;
INTERPOLATION varying vec4 vColor;
void main() {
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
  vColor = color;
}`;
const THIN_FRAGMENT = `
INTERPOLATION varying vec4 vColor;
void main() {
  gl_FragColor = vColor;
}`;

export class ThickLines {
  /** Whether a processor draws; the view finds out when it starts. */
  static isSoftware = false;
  object = new Group();
  #wide;
  #thin;
  #ends = new Float32Array(0);
  #colors = new Uint8Array(0);

  /**
   * `width` [CSS pixels]; lines with `onTop` are seen through everything; those that are `plain`
   * have the same colour at both ends, which a processor draws faster.
   */
  constructor(width, { onTop = false, plain = false } = {}) {
    this.#wide = wideMesh(width, !onTop);
    this.#thin = thinLines(!onTop, plain);
    for (const each of [this.#wide, this.#thin]) {
      each.frustumCulled = false;
      each.renderOrder = onTop ? 5 : 1;
      this.object.add(each);
    }
    this.#grow(16);
  }

  /** Draw before everything else, and hide nothing. */
  layBehind() {
    for (const each of [this.#wide, this.#thin]) {
      each.renderOrder = 0;
      each.material.depthWrite = false;
    }
  }

  /** Room for `count` segments: x, y, z of both ends; and their colours as RGBA bytes. */
  reserve(count) {
    if (6 * count > this.#ends.length) this.#grow(Math.ceil(1.5 * count));
    return { ends: this.#ends, colors: this.#colors };
  }

  /** Show the first `count` segments of what was reserved; `opaque` ones cover what is behind. */
  show(count, { opaque = false } = {}) {
    const isThin = ThickLines.isSoftware && count > MOST_WIDE;
    this.#thin.material.blending = opaque ? NoBlending : NormalBlending;
    this.#wide.visible = count > 0 && !isThin;
    this.#thin.visible = count > 0 && isThin;
    if (isThin) this.#showThin(count);
    else this.#showWide(count);
  }

  dispose() {
    for (const each of [this.#wide, this.#thin]) {
      each.geometry.dispose();
      each.material.dispose();
    }
  }

  #showThin(count) {
    const { attributes } = this.#thin.geometry;
    this.#thin.geometry.setDrawRange(0, 2 * count);
    upload(attributes.position, 6 * count);
    upload(attributes.color, 8 * count);
  }

  #showWide(count) {
    const { attributes } = this.#wide.geometry;
    const [ends, colors] = [attributes.start.data, attributes.startColor.data];
    this.#wide.geometry.setDrawRange(0, 6 * count);
    fourfold(this.#ends, 6, count, ends.array);
    fourfold(this.#colors, 8, count, colors.array);
    upload(ends, 24 * count);
    upload(colors, 32 * count);
  }

  /** The thin lines use the arrays as they are. */
  #grow(count) {
    const [ends, colors] = [new Float32Array(6 * count), new Uint8Array(8 * count)];
    ends.set(this.#ends);
    colors.set(this.#colors);
    [this.#ends, this.#colors] = [ends, colors];
    this.#wide.geometry.dispose();
    this.#wide.geometry = wideGeometry(count);
    this.#thin.geometry.dispose();
    this.#thin.geometry = new BufferGeometry()
      .setAttribute("position", new BufferAttribute(ends, 3).setUsage(DynamicDrawUsage))
      .setAttribute("color", new BufferAttribute(colors, 4, true).setUsage(DynamicDrawUsage));
  }
}

function upload(buffer, count) {
  buffer.clearUpdateRanges();
  buffer.addUpdateRange(0, count);
  buffer.needsUpdate = true;
}

function wideMesh(width, depthTest) {
  const uniforms = {
    viewport: { value: new Vector2(1, 1) }, width: { value: width }, near: { value: 0.01 },
  };
  const material = new ShaderMaterial({
    vertexShader: WIDE_VERTEX, fragmentShader: WIDE_FRAGMENT, uniforms, transparent: true,
    depthTest,
  });
  const mesh = new Mesh(new BufferGeometry(), material);
  mesh.onBeforeRender = (renderer, scene, camera) => {
    const target = renderer.getRenderTarget(); // of another camera's picture
    if (target) uniforms.viewport.value.set(target.width, target.height);
    else renderer.getSize(uniforms.viewport.value);
    uniforms.near.value = camera.near;
  };
  return mesh;
}

function thinLines(depthTest, plain) {
  return new LineSegments(new BufferGeometry(), new ShaderMaterial({
    vertexShader: THIN_VERTEX, fragmentShader: THIN_FRAGMENT, transparent: true, depthTest,
    defines: { INTERPOLATION: plain ? "flat" : "smooth" },
  }));
}

/** Room for `count` segments of four corners each. Not instanced: that is slow on a processor. */
function wideGeometry(count) {
  const buffer = (Kind, size) => new InterleavedBuffer(new Kind(4 * size * count), size)
    .setUsage(DynamicDrawUsage);
  const [ends, colors] = [buffer(Float32Array, 6), buffer(Uint8Array, 8)];
  const corners = new Int8Array(12 * count);
  const index = new Uint32Array(6 * count);
  for (let k = 0; k < count; k += 1) {
    corners.set(CORNERS, 12 * k);
    index.set(TRIANGLES.map((corner) => 4 * k + corner), 6 * k);
  }
  return new BufferGeometry()
    .setIndex(new BufferAttribute(index, 1))
    .setAttribute("position", new BufferAttribute(corners, 3))
    .setAttribute("start", new InterleavedBufferAttribute(ends, 3, 0))
    .setAttribute("end", new InterleavedBufferAttribute(ends, 3, 3))
    .setAttribute("startColor", new InterleavedBufferAttribute(colors, 4, 0, true))
    .setAttribute("endColor", new InterleavedBufferAttribute(colors, 4, 4, true));
}

/** The first `count` rows of `size` numbers, each four times. */
function fourfold(rows, size, count, to) {
  for (let k = 0; k < count; k += 1) {
    for (let corner = 0; corner < 4; corner += 1) {
      for (let i = 0; i < size; i += 1) to[size * (4 * k + corner) + i] = rows[size * k + i];
    }
  }
}
