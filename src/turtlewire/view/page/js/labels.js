// The names in the picture: of the nearest frames that leave each other room, and the important.

import {
  BufferAttribute, BufferGeometry, DynamicDrawUsage, Mesh, ShaderMaterial, Vector2, Vector3,
} from "three";
import { COLUMNS, LabelAtlas, ROWS, SLOT_HEIGHT, SLOT_WIDTH } from "./label_atlas.js";

const MOST = 50;
const CHOOSE_MS = 250;
const RANKS = { selected: -4, hovered: -3, target: -2, root: -1, path: 0 };
const ALWAYS = new Set(["selected", "hovered"]); // also where there is no room
const STAYING = 0.8; // who has a name keeps it rather than one that is a little nearer
const BELOW = 12; // [CSS pixels] from the origin to the middle of the text
const CORNERS = [0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0];
const TRIANGLES = [0, 1, 2, 0, 2, 3];
const ROOM = MOST + 14;
const VERTEX = `
attribute vec3 place;
attribute vec3 slot;
uniform vec2 viewport;
varying vec2 vAt;
varying float vAlpha;
const vec2 SIZE = vec2(${SLOT_WIDTH}.0, ${SLOT_HEIGHT}.0);
const vec2 GRID = vec2(${COLUMNS}.0, ${ROWS}.0);
void main() {
  vec4 at = projectionMatrix * modelViewMatrix * vec4(place, 1.0);
  vec2 anchor = floor((at.xy / at.w * 0.5 + 0.5) * viewport) + vec2(4.0, -${BELOW}.0);
  vec2 corner = vec2(position.x * slot.y, position.y * SIZE.y) - vec2(0.0, 0.5 * SIZE.y);
  at.xy = ((anchor + corner) / viewport * 2.0 - 1.0) * at.w;
  gl_Position = at;
  vec2 cell = vec2(mod(slot.x, GRID.x), GRID.y - 1.0 - floor(slot.x / GRID.x));
  vAt = (cell + vec2(position.x * slot.y / SIZE.x, position.y)) / GRID;
  vAlpha = slot.z;
}`;
const FRAGMENT = `
uniform sampler2D atlas;
varying vec2 vAt;
varying float vAlpha;
void main() {
  gl_FragColor = texture2D(atlas, vAt) * vAlpha;
}`;

export class Labels {
  object;
  /** Whether names stand at frames other than those selected or under the pointer. */
  showAll = true;
  #atlas;
  #geometry = new BufferGeometry();
  #places = attribute(3);
  #slots = attribute(3);
  #view;
  #chosen = []; // { k, width, alpha … }
  #chosenAt = -Infinity;

  constructor(view) {
    this.#view = view;
    this.#atlas = new LabelAtlas(view.isSoftware ? 1 : Math.min(2, Math.ceil(devicePixelRatio)));
    const rooms = Array.from({ length: ROOM }, (_, k) => k);
    this.#geometry.setIndex(rooms.flatMap((k) => TRIANGLES.map((corner) => 4 * k + corner)));
    const corners = Int8Array.from(rooms.flatMap(() => CORNERS));
    this.#geometry.setAttribute("position", new BufferAttribute(corners, 3));
    this.#geometry.setAttribute("place", this.#places);
    this.#geometry.setAttribute("slot", this.#slots);
    const uniforms = { atlas: { value: this.#atlas.texture }, viewport: { value: new Vector2() } };
    const material = new ShaderMaterial({
      vertexShader: VERTEX, fragmentShader: FRAGMENT, uniforms, transparent: true,
      depthTest: false, depthWrite: false, premultipliedAlpha: true,
    });
    this.object = new Mesh(this.#geometry, material);
    this.object.frustumCulled = false;
    this.object.renderOrder = 10;
    this.object.onBeforeRender = () => {
      uniforms.viewport.value.set(view.viewport.width, view.viewport.height);
    };
  }

  /** Choose anew before the next picture. */
  refresh() {
    this.#chosenAt = -Infinity;
  }

  /** Whether the names would be chosen as they are; if not, the next picture chooses. */
  isCurrent(frames, important) {
    const chosen = this.#choose(frames, important).map(({ k }) => k).join();
    if (chosen === this.#chosen.map(({ k }) => k).join()) return true;
    this.refresh();
    return false;
  }

  /**
   * Place the names. `important`: index to style (a key of RANKS), which
   * have one in any case.
   */
  update(frames, important, now) {
    if (now - this.#chosenAt > CHOOSE_MS) {
      this.#chosen = this.#choose(frames, important);
      this.#chosenAt = now;
    }
    const at = [0, 0, 0];
    let count = 0;
    for (const { k, slot, width } of this.#chosen) {
      if (k >= frames.count || !frames.isShown(k)) continue;
      frames.position(k, at);
      const { alpha } = frames.ages.fading(k);
      for (let corner = 4 * count; corner < 4 * count + 4; corner += 1) {
        this.#places.setXYZ(corner, ...at);
        this.#slots.setXYZ(corner, slot, width, alpha);
      }
      count += 1;
    }
    this.#places.needsUpdate = this.#slots.needsUpdate = true;
    this.#geometry.setDrawRange(0, 6 * count);
    this.object.visible = count > 0;
  }

  /** Names in the picture, for the tests. */
  get texts() {
    return this.#chosen.map(({ text }) => text);
  }

  #choose(frames, important) {
    const candidates = this.#candidates(frames, important);
    candidates.sort((a, b) => a.rank - b.rank);
    const taken = [];
    const chosen = [];
    for (const label of candidates) {
      if (chosen.length >= MOST) break;
      label.text = frames.names[label.k];
      Object.assign(label, this.#look(label.style, frames.isConnected(label.k)));
      const width = this.#atlas.widthOf(label.text, label.bold);
      const box = [label.x, label.x + width, label.y + BELOW - 9, label.y + BELOW + 9];
      if (!ALWAYS.has(label.style) && taken.some((other) => overlaps(box, other))) continue;
      taken.push(box);
      chosen.push(label);
    }
    const slots = this.#atlas.slotsFor(chosen, this.#view.colors.halo);
    return chosen.map((label, n) => ({ ...label, ...slots[n] }));
  }

  #candidates(frames, important) {
    const before = new Set(this.#chosen.map(({ text }) => text));
    const point = new Vector3();
    const found = [];
    for (let k = 0; k < frames.count; k += 1) {
      const style = important.get(k);
      if ((!style && !this.showAll) || !frames.isShown(k)) continue;
      const at = this.#view.project(point.set(...frames.position(k)));
      if (!at || at.x < 0 || at.y < 0) continue;
      if (at.x > this.#view.viewport.width || at.y > this.#view.viewport.height) continue;
      const distance = point.distanceTo(this.#view.camera.position);
      const staying = before.has(frames.names[k]) ? STAYING : 1;
      found.push({ k, style, x: at.x, y: at.y, rank: RANKS[style] ?? distance * staying });
    }
    return found;
  }

  #look(style, connected) {
    const { ink, accent, accentInk, bad } = this.#view.colors;
    if (style === "selected") return { bold: true, ink: accentInk, fill: accent };
    if (style === "target" || style === "path") return { bold: true, ink: accent, fill: null };
    const bold = style === "hovered" || style === "root";
    return { bold, ink: connected ? ink : bad, fill: null };
  }
}

function attribute(size) {
  return new BufferAttribute(new Float32Array(4 * size * ROOM), size).setUsage(DynamicDrawUsage);
}

function overlaps([left, right, top, bottom], [left2, right2, top2, bottom2]) {
  return left < right2 && left2 < right && top < bottom2 && top2 < bottom;
}
