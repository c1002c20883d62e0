// What the pens have drawn, kept as lines so that it is sharp at any size.

import { IMAGE_PIXELS } from "./frames.js";

const MOST_LINES = 400_000;
// The same lines in one path of a thousand take half as long again as in short paths.
const LINES_IN_A_PATH = 50;

export class Trails {
  #points = new Float32Array(4 * 1024);
  #pens = new Uint32Array(1024);
  count = 0;

  clear() {
    this.count = 0;
  }

  /** Add lines, and drop the oldest if there are too many; the number of the first new line. */
  append(strokes) {
    if (this.count + strokes.count > MOST_LINES) this.#forgetHalf();
    const first = this.count;
    this.#reserve(first + strokes.count);
    for (let k = 0; k < strokes.count; k += 1) {
      this.#pens[this.count] = strokes.pens[5 * k];
      this.#points.set(strokes.points.subarray(5 * k + 1, 5 * k + 5), 4 * this.count);
      this.count += 1;
    }
    return first;
  }

  /** Draw the lines from `first` on into a square of `size` device pixels, a path for each pen. */
  draw(ctx, size, first = 0) {
    const scale = size / IMAGE_PIXELS;
    ctx.lineCap = "round";
    ctx.lineJoin = "round";
    const points = this.#points;
    for (let start = first, end; start < this.count; start = end) {
      const pen = this.#pens[start];
      ctx.strokeStyle = `rgb(${pen >>> 24} ${(pen >>> 16) & 255} ${(pen >>> 8) & 255})`;
      ctx.lineWidth = (pen & 255) * scale;
      ctx.beginPath();
      const limit = Math.min(this.count, start + LINES_IN_A_PATH);
      for (end = start; end < limit && this.#pens[end] === pen; end += 1) {
        ctx.moveTo(points[4 * end] * scale, points[4 * end + 1] * scale);
        ctx.lineTo(points[4 * end + 2] * scale, points[4 * end + 3] * scale);
      }
      ctx.stroke();
    }
  }

  #reserve(count) {
    if (count <= this.#pens.length) return;
    const capacity = Math.max(count, 2 * this.#pens.length);
    const [points, pens] = [new Float32Array(4 * capacity), new Uint32Array(capacity)];
    points.set(this.#points);
    pens.set(this.#pens);
    [this.#points, this.#pens] = [points, pens];
  }

  #forgetHalf() {
    const kept = this.count >> 1;
    this.#points.copyWithin(0, 4 * (this.count - kept), 4 * this.count);
    this.#pens.copyWithin(0, this.count - kept, this.count);
    this.count = kept;
  }
}
