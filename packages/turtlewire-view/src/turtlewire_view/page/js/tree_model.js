// The rows of the tree of frames: order, search, folded branches.

import { byName } from "../kit/names.js";

export class TreeModel {
  /** Name to the server's row: publisher, rate, age, delay, static. */
  readings = new Map();
  #frames;
  #children = new Map(); // index to indices of children in order; -1 to the roots
  #order = [];
  #folded = new Set(); // names
  #query = "";

  constructor(frames) {
    this.#frames = frames;
  }

  /** After other names: order again. */
  rebuild() {
    const { names, parents, trees, fixed } = this.#frames;
    const main = trees[this.#frames.index(fixed)];
    const order = names.map((_, k) => k);
    order.sort((a, b) => byName(names[a], names[b]));
    order.sort((a, b) => (trees[b] === main) - (trees[a] === main));
    this.#order = order;
    this.#children = new Map();
    for (const k of order) {
      const siblings = this.#children.get(parents[k]);
      if (siblings) siblings.push(k);
      else this.#children.set(parents[k], [k]);
    }
  }

  search(query) {
    this.#query = query.trim().toLowerCase();
  }

  get isSearching() {
    return this.#query !== "";
  }

  fold(name, folded) {
    if (folded) this.#folded.add(name);
    else this.#folded.delete(name);
  }

  /** Open everything above a frame, so that it has a row. */
  reveal(k) {
    const { names, parents } = this.#frames;
    let at = parents[k];
    for (let step = 0; at >= 0 && step < names.length; step += 1, at = parents[at]) {
      this.#folded.delete(names[at]);
    }
  }

  /**
   * Rows from the top: { k, depth, place, count, fold: "none", "open" or "closed", found }; `place`
   * is that among `count` siblings, from 1. While searching they are the rows that match, without
   * what is above them: `found` is where in the name, or -1.
   */
  rows() {
    return this.isSearching ? this.#matches() : this.#unfolded();
  }

  #unfolded() {
    const rows = [];
    const stack = this.#below(-1, 0);
    while (stack.length) {
      const row = stack.pop();
      const { k } = row;
      const below = this.#below(k, row.depth + 1);
      const closed = this.#folded.has(this.#frames.names[k]);
      const fold = below.length === 0 ? "none" : closed ? "closed" : "open";
      rows.push({ ...row, fold, found: null });
      if (!closed) stack.push(...below);
    }
    return rows;
  }

  /** Children in reverse: the stack takes the first one first. */
  #below(k, depth) {
    const children = this.#children.get(k) ?? [];
    const count = children.length;
    return children.map((child, n) => ({ k: child, depth, place: n + 1, count })).reverse();
  }

  /** Frames whose name or publisher contains the search text. */
  #matches() {
    const rows = this.#order.flatMap((k) => {
      const name = this.#frames.names[k];
      const found = name.toLowerCase().indexOf(this.#query);
      const publisher = this.readings.get(name)?.publisher ?? "";
      const isMatch = found >= 0 || publisher.toLowerCase().includes(this.#query);
      return isMatch ? [{ k, depth: 0, fold: "none", found }] : [];
    });
    return rows.map((row, n) => ({ ...row, place: n + 1, count: rows.length }));
  }

  /** Length of what is searched for, to mark it. */
  get queryLength() {
    return this.#query.length;
  }
}
