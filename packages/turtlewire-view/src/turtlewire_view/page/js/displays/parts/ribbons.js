// Line segments as wide as they are in metres, and never thinner than some pixels.

import {
  BufferAttribute, DoubleSide, InstancedBufferAttribute, InstancedBufferGeometry, Mesh,
  ShaderMaterial, Sphere, Vector2, Vector3,
} from "three";
import { sizeDrawn } from "./common.js";

const CORNERS = new Float32Array([0, -1, 0, 0, 1, 0, 1, 1, 0, 1, -1, 0]);
const VERTEX = `
attribute vec3 start;
attribute vec3 end;
attribute vec4 startColor;
attribute vec4 endColor;
uniform vec2 pixels;
uniform float width;
uniform float least;
uniform float near;
varying vec4 vColor;
void main() {
  vec4 a = modelViewMatrix * vec4(start, 1.0);
  vec4 b = modelViewMatrix * vec4(end, 1.0);
  if (a.z > -near && b.z < -near) a = mix(b, a, (b.z + near) / (b.z - a.z));
  else if (b.z > -near && a.z < -near) b = mix(a, b, (a.z + near) / (a.z - b.z));
  vec4 p = projectionMatrix * a;
  vec4 q = projectionMatrix * b;
  vec2 along = (q.xy / q.w - p.xy / p.w) * pixels;
  along = dot(along, along) > 1e-8 ? normalize(along) : vec2(1.0, 0.0);
  vec4 at = position.x < 0.5 ? p : q;
  float wide = width * projectionMatrix[1][1] * pixels.y * 0.5 / at.w;
  wide = max(wide, least);
  vec2 aside = vec2(-along.y, along.x) * position.y;
  vec2 beyond = along * (position.x < 0.5 ? -0.5 : 0.5) * min(wide, 4.0);
  at.xy += (aside * wide + beyond) / pixels * at.w;
  gl_Position = at;
  vColor = position.x < 0.5 ? startColor : endColor;
}`;
const FRAGMENT = `
uniform float alpha;
varying vec4 vColor;
void main() {
  gl_FragColor = vec4(vColor.rgb, vColor.a * alpha);
}`;

/**
 * Segments between points (x, y, z): of each with the next one, or of pairs.
 * `colors`: RGBA bytes, one for all points or one for each.
 */
export function makeRibbons(points, colors, { pairs = false, width = 0, least = 2, alpha = 1 }) {
  const step = pairs ? 2 : 1;
  const count = Math.max(0, pairs ? Math.floor(points.length / 6) : points.length / 3 - 1);
  const starts = new Float32Array(3 * count);
  const ends = new Float32Array(3 * count);
  const colorOf = (k) => (colors.length > 4 ? colors.subarray(4 * k, 4 * k + 4) : colors);
  const tints = [new Uint8Array(4 * count), new Uint8Array(4 * count)];
  for (let k = 0; k < count; k += 1) {
    const at = step * k;
    starts.set(points.subarray(3 * at, 3 * at + 3), 3 * k);
    ends.set(points.subarray(3 * at + 3, 3 * at + 6), 3 * k);
    tints[0].set(colorOf(at), 4 * k);
    tints[1].set(colorOf(at + 1), 4 * k);
  }
  const geometry = new InstancedBufferGeometry();
  geometry.instanceCount = count;
  geometry.setIndex([0, 2, 1, 0, 3, 2]);
  geometry.setAttribute("position", new BufferAttribute(CORNERS, 3));
  geometry.setAttribute("start", new InstancedBufferAttribute(starts, 3));
  geometry.setAttribute("end", new InstancedBufferAttribute(ends, 3));
  geometry.setAttribute("startColor", new InstancedBufferAttribute(tints[0], 4, true));
  geometry.setAttribute("endColor", new InstancedBufferAttribute(tints[1], 4, true));
  geometry.boundingSphere = new Sphere(new Vector3(), Infinity);
  const isClear = alpha < 1 || tints.some((bytes) => bytes.some((b, k) => k % 4 === 3 && b < 255));
  const material = new ShaderMaterial({
    vertexShader: VERTEX,
    fragmentShader: FRAGMENT,
    uniforms: {
      pixels: { value: new Vector2(1, 1) },
      width: { value: width },
      least: { value: least },
      near: { value: 0.01 },
      alpha: { value: alpha },
    },
    transparent: isClear,
    depthWrite: !isClear,
    side: DoubleSide,
  });
  const mesh = new Mesh(geometry, material);
  mesh.frustumCulled = false;
  mesh.raycast = () => {}; // the geometry holds no places
  mesh.visible = count > 0;
  mesh.onBeforeRender = (renderer, scene, camera) => {
    const ratio = sizeDrawn(renderer, material.uniforms.pixels.value);
    material.uniforms.least.value = least * ratio;
    material.uniforms.near.value = camera.near;
  };
  return mesh;
}
