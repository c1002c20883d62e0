// Texts drawn once into one texture, each in its own slot.

import { CanvasTexture, LinearFilter, NearestFilter } from "three";

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
