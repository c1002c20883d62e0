// The names in the picture: of the nearest frames that leave each other room, and the important.
// Texts drawn once into one texture, each in its own slot.

import {
  BufferAttribute, BufferGeometry, CanvasTexture, DynamicDrawUsage, LinearFilter, Mesh,
  NearestFilter, ShaderMaterial, Vector2, Vector3,
} from "three";

export const SLOT_WIDTH = 240; // [CSS pixels]
export const SLOT_HEIGHT = 24;
export const COLUMNS = 4;
export const ROWS = 16;
const FONT = '13px system-ui, -apple-system, "Segoe UI", Roboto, "Noto Sans", sans-serif';
const PADDING = 7;

export class LabelAtlas {
  texture;
  #ctx;
  #ratio;
  #slots = new Map(); // key to { slot, width }
  #free = Array.from({ length: COLUMNS * ROWS }, (_, k) => k);

  constructor(ratio) {
    const canvas = document.createElement("canvas");
    canvas.width = COLUMNS * SLOT_WIDTH * ratio;
    canvas.height = ROWS * SLOT_HEIGHT * ratio;
    this.#ratio = ratio;
    this.#ctx = canvas.getContext("2d");
    this.texture = new CanvasTexture(canvas);
    this.texture.generateMipmaps = false;
    // Names stand on whole pixels, so at one to one the nearest texel is exact, and much cheaper.
    const filter = ratio === 1 ? NearestFilter : LinearFilter;
    this.texture.minFilter = this.texture.magFilter = filter;
    this.texture.premultiplyAlpha = true;
  }

  /** Width of a text as it will stand [CSS pixels]. */
  widthOf(text, bold) {
    this.#ctx.font = bold ? `600 ${FONT}` : FONT;
    return Math.min(SLOT_WIDTH, this.#ctx.measureText(text).width + 2 * PADDING);
  }

  /**
   * Slots for `labels` ({ text, bold, ink, fill }, `fill` null for a halo of colour `halo`), in
   * order; those no longer wanted are free again.
   */
  slotsFor(labels, halo) {
    const keyOf = ({ text, bold, ink, fill }) => JSON.stringify([text, bold, ink, fill, halo]);
    const keys = labels.map(keyOf);
    const wanted = new Set(keys);
    for (const [key, { slot }] of this.#slots) {
      if (wanted.has(key)) continue;
      this.#slots.delete(key);
      this.#free.push(slot);
    }
    labels.forEach((label, k) => {
      if (!this.#slots.has(keys[k])) this.#slots.set(keys[k], this.#draw(label, halo));
    });
    return keys.map((key) => this.#slots.get(key));
  }

  #draw({ text, bold, ink, fill }, halo) {
    const slot = this.#free.pop();
    const ctx = this.#ctx;
    const [column, row] = [slot % COLUMNS, Math.floor(slot / COLUMNS)];
    const width = this.widthOf(text, bold);
    ctx.save();
    ctx.scale(this.#ratio, this.#ratio);
    ctx.translate(column * SLOT_WIDTH, row * SLOT_HEIGHT);
    ctx.clearRect(0, 0, SLOT_WIDTH, SLOT_HEIGHT);
    ctx.font = bold ? `600 ${FONT}` : FONT;
    ctx.textBaseline = "middle";
    const [x, y] = [PADDING, SLOT_HEIGHT / 2 + 0.5];
    if (fill) {
      ctx.fillStyle = fill;
      ctx.beginPath();
      ctx.roundRect(1, 2, width - 2, SLOT_HEIGHT - 4, 9);
      ctx.fill();
    } else {
      ctx.strokeStyle = halo;
      ctx.lineWidth = 4;
      ctx.lineJoin = "round";
      ctx.strokeText(text, x, y, SLOT_WIDTH - 2 * PADDING);
    }
    ctx.fillStyle = ink;
    ctx.fillText(text, x, y, SLOT_WIDTH - 2 * PADDING);
    ctx.restore();
    this.texture.needsUpdate = true;
    return { slot, width };
  }
}

const MOST = 50;
const CHOOSE_MS = 250;
const RANKS = { selected: -4, hovered: -3, target: -2, root: -1, path: 0 };
const ALWAYS = new Set(["selected", "hovered"]); // on another side where there is no room
const STAYING = 0.8; // a frame keeps its label unless another one is clearly nearer
/** Positions of a name next to its origin, by preference: [to the right, below]. */
const SIDES = [[true, true], [false, true], [true, false], [false, false]];
const [BESIDE, BELOW] = [4, 12]; // [CSS pixels] from the origin to the text's edge and middle
const HALF_HEIGHT = 9; // [CSS pixels]
const CORNERS = [0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0];
const TRIANGLES = [0, 1, 2, 0, 2, 3];
const ROOM = MOST + 14;
const VERTEX = `
attribute vec3 place;
attribute vec3 slot;
attribute vec2 aside;
uniform vec2 viewport;
varying vec2 vAt;
varying float vAlpha;
const vec2 SIZE = vec2(${SLOT_WIDTH}.0, ${SLOT_HEIGHT}.0);
const vec2 GRID = vec2(${COLUMNS}.0, ${ROWS}.0);
void main() {
  vec4 at = projectionMatrix * modelViewMatrix * vec4(place, 1.0);
  vec2 anchor = floor((at.xy / at.w * 0.5 + 0.5) * viewport) + aside;
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
  /** The names in the last picture, and where: { text, box: [left, right, top, bottom] }. */
  shown = [];
  /** Whether names are shown for frames that are neither selected nor under the pointer. */
  showAll = true;
  #atlas;
  #geometry = new BufferGeometry();
  #places = attribute(3);
  #slots = attribute(3);
  #asides = attribute(2);
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
    this.#geometry.setAttribute("aside", this.#asides);
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

  /** Choose again before the next picture. */
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
    this.shown = [];
    const at = [0, 0, 0];
    for (const label of this.#chosen) {
      if (label.k >= frames.count || !frames.isShown(label.k)) continue;
      const seen = this.#view.project(new Vector3(...frames.position(label.k, at)));
      const spot = seen && this.#spotFor(label, seen, this.shown);
      if (spot) this.#put(label, at, spot, frames.ages.fading(label.k).alpha);
    }
    for (const each of [this.#places, this.#slots, this.#asides]) each.needsUpdate = true;
    this.#geometry.setDrawRange(0, 6 * this.shown.length);
    this.object.visible = this.shown.length > 0;
  }

  /** Names in the picture, for the tests. */
  get texts() {
    return this.#chosen.map(({ text }) => text);
  }

  #put({ text, slot, width }, at, { box, aside }, alpha) {
    const first = 4 * this.shown.length;
    for (let corner = first; corner < first + 4; corner += 1) {
      this.#places.setXYZ(corner, ...at);
      this.#slots.setXYZ(corner, slot, width, alpha);
      this.#asides.setXY(corner, ...aside);
    }
    this.shown.push({ text, box });
  }

  /**
   * Where a name stands beside its origin at { x, y }, without touching those in `taken`: its
   * `box`, and its offset `aside` from the origin, with y upwards; null if there is no space.
   */
  #spotFor({ style, width }, { x, y }, taken) {
    const last = Math.max(0, this.#view.viewport.width - width); // in the picture
    const spots = SIDES.map(([isRight, isBelow]) => {
      const left = Math.min(last, Math.max(0, isRight ? x + BESIDE : x - BESIDE - width));
      const middle = isBelow ? y + BELOW : y - BELOW;
      const box = [left, left + width, middle - HALF_HEIGHT, middle + HALF_HEIGHT];
      return { box, aside: [left - x, y - middle].map(Math.round) }; // texts stand on pixels
    });
    const isFree = ({ box }) => !taken.some((other) => overlaps(box, other.box));
    if (ALWAYS.has(style)) return spots.find(isFree) ?? spots[0];
    return isFree(spots[0]) ? spots[0] : null;
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
      label.width = this.#atlas.widthOf(label.text, label.bold);
      const spot = this.#spotFor(label, label, taken);
      if (!spot) continue;
      taken.push(spot);
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
