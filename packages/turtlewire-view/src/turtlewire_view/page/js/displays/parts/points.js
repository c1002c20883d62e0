// Many points in one draw call, some pixels or some metres wide, in exactly the colours given.

import { BufferAttribute, BufferGeometry, Points, ShaderMaterial, Vector2 } from "three";
import { sizeDrawn } from "./common.js";

const VERTEX = `
attribute vec4 rgba;
uniform vec2 pixels;
uniform float size;
uniform bool metres;
uniform bool perDepth;
varying vec4 vColor;
void main() {
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
  float wide = (perDepth ? position.z : 1.0) * size;
  wide *= projectionMatrix[1][1] * pixels.y * 0.5 / gl_Position.w;
  gl_PointSize = metres ? clamp(wide, 2.0, 512.0) : size;
  vColor = rgba;
}`;
const FRAGMENT = `
uniform float alpha;
uniform bool round;
varying vec4 vColor;
void main() {
  vec2 from = gl_PointCoord - vec2(0.5);
  float light = 1.0;
  if (round) {
    float height = 1.0 - 4.0 * dot(from, from);
    if (height < 0.0) discard;
    light = 0.45 + 0.55 * sqrt(height);
  }
  gl_FragColor = vec4(vColor.rgb * light, vColor.a * alpha);
}`;

/**
 * Points at `positions` (x, y, z) with `colors` (RGBA bytes).
 * `size` is in metres, in metres for each metre of z (`perDepth`), or in pixels of the screen;
 * `round` ones look like balls.
 */
export function makePoints(positions, colors, look) {
  const { size, metres = false, perDepth = false, alpha = 1, round = false } = look;
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(positions, 3));
  geometry.setAttribute("rgba", new BufferAttribute(colors, 4, true));
  let isClear = alpha < 1;
  for (let k = 3; !isClear && k < colors.length; k += 4) isClear = colors[k] < 255;
  const material = new ShaderMaterial({
    vertexShader: VERTEX,
    fragmentShader: FRAGMENT,
    uniforms: {
      pixels: { value: new Vector2(1, 1) },
      size: { value: size },
      metres: { value: metres },
      perDepth: { value: perDepth },
      alpha: { value: alpha },
      round: { value: round },
    },
    transparent: isClear,
    depthWrite: !isClear,
  });
  const points = new Points(geometry, material);
  points.onBeforeRender = (renderer) => {
    const ratio = sizeDrawn(renderer, material.uniforms.pixels.value);
    material.uniforms.size.value = metres ? size : size * ratio;
  };
  return points;
}
