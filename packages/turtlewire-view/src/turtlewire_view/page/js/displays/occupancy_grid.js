// OccupancyGrid: one textured rectangle; a palette turns cells into colours.

import {
  DataTexture, DoubleSide, Mesh, NearestFilter, PlaneGeometry, RedFormat, ShaderMaterial,
} from "three";
import { clear, setPose } from "./parts/common.js";

const UNKNOWN = [0x70, 0x89, 0x86, 255];
const VERTEX = `
varying vec2 vAt;
void main() {
  vAt = uv;
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
}`;
const FRAGMENT = `
uniform sampler2D cells;
uniform sampler2D palette;
uniform float alpha;
varying vec2 vAt;
void main() {
  float cell = texture2D(cells, vAt).r * 255.0;
  vec4 color = texture2D(palette, vec2((cell + 0.5) / 256.0, 0.5));
  if (color.a == 0.0) discard;
  gl_FragColor = vec4(color.rgb, color.a * alpha);
}`;

export default class OccupancyGrid {
  #options;
  #cells = null; // DataTexture
  #mesh = null;
  #view;
  #frame = null; // that the map goes with

  constructor(view, options) {
    this.#view = view;
    this.#options = options;
  }

  show(group, header, arrays, shapes) {
    if (header.update) return this.#patch(header.update, arrays.cells);
    this.#replace(group, header, arrays.cells, shapes.cells);
    this.#frame = header.frame ?? null;
    this.update();
  }

  /** After each packet of frames: the server only reports why a map has no pose at its stamp. */
  update() {
    const isLost = this.#frame !== null && this.#view.poseOf(this.#frame) === null;
    this.#view.report(isLost ? `No transform from the map's frame '${this.#frame}'` : "");
  }

  setOptions(options) {
    this.#options = options;
    if (this.#mesh) this.#applyOptions();
  }

  dispose() {
    this.#cells?.dispose();
    this.#mesh?.material.uniforms.palette.value.dispose();
  }

  #replace(group, { resolution, origin }, cells, [rows, columns]) {
    clear(group);
    this.#cells?.dispose();
    const bytes = new Uint8Array(cells.buffer, cells.byteOffset, cells.length).slice();
    this.#cells = new DataTexture(bytes, columns, rows, RedFormat);
    this.#cells.minFilter = this.#cells.magFilter = NearestFilter;
    this.#cells.unpackAlignment = 1;
    this.#cells.needsUpdate = true;
    const [width, height] = [columns * resolution, rows * resolution];
    const material = new ShaderMaterial({
      vertexShader: VERTEX,
      fragmentShader: FRAGMENT,
      uniforms: {
        cells: { value: this.#cells }, palette: { value: null }, alpha: { value: 1 },
      },
      side: DoubleSide,
      transparent: true,
      depthWrite: false,
    });
    const plane = new PlaneGeometry(width, height).translate(width / 2, height / 2, 0);
    this.#mesh = setPose(new Mesh(plane, material), origin);
    group.add(this.#mesh);
    this.#applyOptions();
  }

  #patch([x, y, width, height], cells) {
    const image = this.#cells?.image;
    if (!image || x + width > image.width || y + height > image.height) return;
    const bytes = new Uint8Array(cells.buffer, cells.byteOffset, cells.length);
    for (let row = 0; row < height; row += 1) {
      const line = bytes.subarray(row * width, (row + 1) * width);
      image.data.set(line, (y + row) * image.width + x);
    }
    this.#cells.needsUpdate = true;
  }

  #applyOptions() {
    const { color_scheme: scheme, alpha, draw_behind: isBehind } = this.#options;
    const { material } = this.#mesh;
    material.uniforms.palette.value?.dispose();
    material.uniforms.palette.value = paletteOf(scheme);
    material.uniforms.alpha.value = alpha;
    material.depthTest = !isBehind;
    this.#mesh.renderOrder = isBehind ? -100 : -1;
  }
}

/** RViz's colours of the bytes 0 to 255; -1 is 255. */
function paletteOf(scheme) {
  const colors = { map: mapColor, costmap: costColor, raw: (k) => [k, k, k, 255] }[scheme];
  const bytes = new Uint8Array(4 * 256);
  for (let k = 0; k < 256; k += 1) bytes.set(colors(k), 4 * k);
  const texture = new DataTexture(bytes, 256, 1);
  texture.minFilter = texture.magFilter = NearestFilter;
  texture.needsUpdate = true;
  return texture;
}

function mapColor(k) {
  if (k <= 100) {
    const grey = 255 - Math.floor((255 * k) / 100);
    return [grey, grey, grey, 255];
  }
  return illegalColor(k);
}

function costColor(k) {
  if (k === 0) return [0, 0, 0, 0];
  if (k === 99) return [0, 255, 255, 255];
  if (k === 100) return [255, 0, 255, 255];
  if (k > 100) return illegalColor(k);
  const red = Math.floor((255 * k) / 100);
  return [red, 0, 255 - red, 255];
}

/** Green above 100, red to yellow below -1. */
function illegalColor(k) {
  if (k === 255) return UNKNOWN;
  if (k < 128) return [0, 255, 0, 255];
  return [255, Math.floor((255 * (k - 128)) / (254 - 128)), 0, 255];
}
