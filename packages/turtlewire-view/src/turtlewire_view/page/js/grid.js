// The ground: squares around the fixed frame's origin that fade outwards.

import { ThickLines } from "./thick_lines.js";
import { bytesOf } from "./colors.js";

const CELLS = 10; // to each side
const PIECES = 4; // of a line, so that it can fade

export class Grid {
  object;
  /** Side of a square [m]. */
  cell = 1;
  #lines = new ThickLines(1);
  #color = [128, 128, 128];
  #shift = [0, 0, 0];

  constructor() {
    this.object = this.#lines.object;
    this.#lines.layBehind();
  }

  setColors(colors) {
    this.#color = bytesOf(colors.grid);
    this.#rebuild();
  }

  setCell(metres) {
    if (metres === this.cell) return;
    this.cell = metres;
    this.#rebuild();
  }

  /** Keep the lines on whole multiples of the cell although the server subtracts `origin`. */
  setOrigin([x, y, z]) {
    const shift = [x % this.cell, y % this.cell, 0].map((value) => -value);
    shift[2] = Math.abs(z) < 1000 ? -z : 0;
    if (shift.every((value, k) => value === this.#shift[k])) return;
    this.#shift = shift;
    this.object.position.set(...shift);
  }

  #rebuild() {
    const count = 2 * (2 * CELLS + 1) * 2 * PIECES;
    const { ends, colors } = this.#lines.reserve(count);
    const step = (CELLS * this.cell) / PIECES;
    let at = 0;
    for (let row = -CELLS; row <= CELLS; row += 1) {
      const across = row * this.cell;
      for (let piece = -PIECES; piece < PIECES; piece += 1) {
        const [from, to] = [piece * step, (piece + 1) * step];
        const alphas = [from, to].map((along) => this.#alpha(across, along, row));
        this.#put(ends, colors, at, [from, across, to, across], alphas);
        this.#put(ends, colors, at + 1, [across, from, across, to], alphas);
        at += 2;
      }
    }
    this.#lines.show(count);
  }

  #alpha(across, along, row) {
    const away = Math.hypot(across, along) / (CELLS * this.cell);
    const strength = row === 0 ? 0.85 : row % 5 === 0 ? 0.6 : 0.38;
    return 255 * strength * Math.max(0, 1 - away * away);
  }

  #put(ends, colors, at, [x0, y0, x1, y1], [alpha0, alpha1]) {
    ends.set([x0, y0, 0, x1, y1, 0], 6 * at);
    colors.set([...this.#color, alpha0, ...this.#color, alpha1], 8 * at);
  }
}
