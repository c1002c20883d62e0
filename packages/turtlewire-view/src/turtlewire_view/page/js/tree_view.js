// The tree of frames as rows; only those in sight are elements.
// The rows of the tree of frames: order, search, folded branches.

import { byId, make, setText } from "../kit/dom.js";
import { byName } from "../kit/names.js";
import { kindOf, readingInWords } from "./words.js";

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

const ROW_REM = 2.5;
const SPARE = 4; // rows above and below those in sight
const EYE = '<svg viewBox="0 0 24 24" aria-hidden="true"><path class="lid" '
  + 'd="M2 12s4-6 10-6 10 6 10 6-4 6-10 6S2 12 2 12zM12 9a3 3 0 1 0 .01 0"/>'
  + '<path class="slash" d="M3 12c4 5 14 5 18 0M6 16l-2 3M12 17v3M18 16l2 3"/></svg>';

/**
 * The name of a row is that of its frame: the reading, which changes each second, is its
 * description, and keys fold it.
 */
const HIDDEN = { "aria-hidden": "true" };

export class TreeView {
  #frames;
  #actions;
  #model;
  #rows = [];
  #elements = new Map(); // index of the frame to element
  #selected = "";
  #path = new Set();
  #hovered = -1;
  #active = -1; // row of the keyboard
  #height = 0; // of the box, before it changed [px]
  #box = byId("tree");
  #inside = byId("tree-rows");

  /** `actions`: select(name, event), hide(name, on), hover(index), follow(name). */
  constructor(frames, actions) {
    this.#frames = frames;
    this.#actions = actions;
    this.#model = new TreeModel(frames);
    this.#box.addEventListener("scroll", () => this.#draw(), { passive: true });
    this.#box.addEventListener("keydown", (event) => this.#key(event));
    this.#box.addEventListener("pointerleave", () => actions.hover(-1));
    new ResizeObserver(() => this.#keepInSight()).observe(this.#box);
    byId("search").addEventListener("input", ({ target }) => {
      this.#model.search(target.value);
      this.#box.scrollTop = 0;
      this.#layout();
    });
  }

  /** Other names or parents. */
  rebuild() {
    this.#model.rebuild();
    for (const element of this.#elements.values()) element.remove();
    this.#elements.clear();
    byId("no-frames").hidden = this.#frames.count > 0;
    this.#box.hidden = this.#frames.count === 0;
    const trees = this.#frames.roots.length;
    const apart = trees > 1 ? ` in ${trees} trees` : "";
    setText(byId("frame-count"), this.#frames.count ? `${this.#frames.count}${apart}` : "");
    this.#layout();
  }

  /** The server's rows. */
  showReadings(rows) {
    this.#model.readings = new Map(rows.map((row) => [row.name, row]));
    if (this.#model.isSearching) this.#layout();
    else this.#draw();
  }

  get hasReadings() {
    return this.#model.readings.size > 0;
  }

  readingOf(name) {
    return this.#model.readings.get(name);
  }

  /** The selected frame's name, and indices on its path. */
  showSelection(name, path) {
    this.#path = new Set(path);
    const isNew = name !== this.#selected;
    this.#selected = name;
    const k = this.#frames.index(name);
    if (!isNew || k < 0) return this.#draw();
    this.#model.reveal(k);
    this.#layout();
    const at = this.#rows.findIndex((row) => row.k === k);
    if (at >= 0) this.#activate(at);
    else this.#active = -1; // the search does not find it
  }

  showHovered(k) {
    this.#elements.get(this.#hovered)?.removeAttribute("data-hovered");
    this.#elements.get(k)?.setAttribute("data-hovered", "");
    this.#hovered = k;
  }

  #layout() {
    this.#rows = this.#model.rows();
    const isLost = this.#model.isSearching && !this.#rows.length;
    byId("no-match").hidden = !isLost;
    setText(byId("no-match"), isLost ? "No frame or publisher matches." : "");
    this.#inside.style.height = `${this.#rows.length * ROW_REM}rem`;
    this.#draw();
  }

  #rowPixels() {
    return ROW_REM * parseFloat(getComputedStyle(document.documentElement).fontSize);
  }

  #draw() {
    const height = this.#rowPixels();
    const first = Math.max(0, Math.floor(this.#box.scrollTop / height) - SPARE);
    const count = Math.ceil(this.#box.clientHeight / height) + 2 * SPARE;
    const visible = this.#rows.slice(first, first + count);
    const wanted = new Set(visible.map(({ k }) => k));
    for (const [k, element] of this.#elements) {
      if (wanted.has(k)) continue;
      element.remove();
      this.#elements.delete(k);
    }
    visible.forEach((row, n) => this.#drawRow(row, first + n));
  }

  #drawRow(row, at) {
    const name = this.#frames.names[row.k];
    const reading = this.readingOf(name);
    let element = this.#elements.get(row.k);
    if (!element) {
      element = this.#makeRow(row.k, name);
      this.#elements.set(row.k, element);
      this.#inside.append(element);
    }
    element.style.top = `${at * ROW_REM}rem`;
    element.style.setProperty("--depth", Math.min(row.depth, 12));
    element.setAttribute("aria-level", row.depth + 1);
    element.setAttribute("aria-posinset", row.place); // not all rows are elements
    element.setAttribute("aria-setsize", row.count);
    element.setAttribute("aria-selected", String(name === this.#selected));
    element.dataset.kind = this.#frames.parents[row.k] < 0 ? "root" : kindOf(reading);
    element.toggleAttribute("data-path", this.#path.has(row.k));
    element.toggleAttribute("data-active", at === this.#active);
    element.toggleAttribute("data-apart", this.#isRootApart(row.k));
    this.#drawFold(element, row, name);
    this.#drawEye(element, row.k);
    this.#drawName(element.querySelector(".name"), name, row.found);
    const text = this.#readingText(row.k, reading);
    setText(element.querySelector("small"), text);
    element.title = name;
    element.setAttribute("aria-description", text);
  }

  #readingText(k, reading) {
    const above = this.#frames.names[this.#frames.parents[k]];
    const place = this.#model.isSearching ? `below ${above} · ` : "";
    if (above !== undefined) return place + readingInWords(reading);
    return this.#frames.isConnected(k) ? "root" : "root · not connected to the fixed frame";
  }

  #isRootApart(k) {
    return this.#frames.parents[k] < 0 && this.#frames.roots.length > 1;
  }

  #drawFold(element, row, name) {
    const fold = element.querySelector(".fold");
    fold.hidden = row.fold === "none";
    setText(fold, row.fold === "closed" ? "▸" : "▾");
    fold.setAttribute("aria-label", `${row.fold === "closed" ? "Unfold" : "Fold"} ${name}`);
    if (row.fold === "none") element.removeAttribute("aria-expanded");
    else element.setAttribute("aria-expanded", String(row.fold === "open"));
  }

  #drawEye(element, k) {
    const isHidden = this.#frames.hidden[k] === 1;
    element.toggleAttribute("data-hidden", isHidden);
    element.querySelector(".eye").setAttribute("aria-pressed", String(isHidden));
  }

  #drawName(element, name, found) {
    if (found === null || found < 0) return setText(element, name);
    const end = found + this.#model.queryLength;
    const mark = make("mark", { textContent: name.slice(found, end) });
    element.replaceChildren(name.slice(0, found), mark, name.slice(end));
  }

  #makeRow(k, name) {
    const [fold, eye] = ["fold", "eye"].map((className) => {
      return make("button", { type: "button", className, tabIndex: -1, ...HIDDEN });
    });
    eye.title = "Hide";
    eye.setAttribute("aria-label", `Hide ${name}`);
    eye.innerHTML = EYE;
    const row = make(
      "div", { className: "row", id: `frame-${k}`, role: "treeitem" },
      fold, make("i", { className: "dot" }), make("span", { className: "name" }),
      make("small", HIDDEN), eye,
    );
    row.onclick = (event) => this.#actions.select(name, event);
    row.ondblclick = () => this.#actions.follow(name);
    row.onpointerenter = () => this.#actions.hover(k);
    fold.onclick = (event) => {
      event.stopPropagation();
      this.#setFolded(name, row.getAttribute("aria-expanded") === "true");
    };
    eye.onclick = (event) => {
      event.stopPropagation();
      this.#actions.hide(name, this.#frames.hidden[k] === 0);
    };
    return row;
  }

  #setFolded(name, folded) {
    this.#model.fold(name, folded);
    this.#layout();
  }

  /** When the box becomes smaller, the selected row stays in sight if it was. */
  #keepInSight() {
    const at = this.#rows.findIndex(({ k }) => this.#frames.names[k] === this.#selected);
    const { scrollTop } = this.#box;
    const row = this.#rowPixels();
    const wasInSight = at * row >= scrollTop && (at + 1) * row <= scrollTop + this.#height;
    this.#height = this.#box.clientHeight;
    if (at >= 0 && wasInSight && this.#height) this.#scrollTo(at);
    else this.#draw();
  }

  #scrollTo(at) {
    const height = this.#rowPixels();
    const { scrollTop, clientHeight } = this.#box;
    if (at * height < scrollTop) this.#box.scrollTop = at * height;
    else if ((at + 1) * height > scrollTop + clientHeight) {
      this.#box.scrollTop = (at + 1) * height - clientHeight;
    }
    this.#draw();
  }

  #activate(at) {
    this.#active = at;
    this.#scrollTo(at);
    this.#box.setAttribute("aria-activedescendant", `frame-${this.#rows[at]?.k}`);
  }

  /** Unfold, or go to the first frame below. */
  #unfold({ k, fold }) {
    if (fold === "closed") this.#setFolded(this.#frames.names[k], false);
    else if (fold === "open") this.#activate(this.#active + 1);
  }

  /** Fold, or go to the frame above. */
  #fold({ k, fold }) {
    const above = this.#rows.findIndex((row) => row.k === this.#frames.parents[k]);
    if (fold === "open") this.#setFolded(this.#frames.names[k], true);
    else if (above >= 0) this.#activate(above);
  }

  #key(event) {
    const row = this.#rows[this.#active];
    const moves = { ArrowDown: 1, ArrowUp: -1, PageDown: 10, PageUp: -10, Home: -1e9, End: 1e9 };
    if (event.target !== this.#box || event.ctrlKey || event.altKey || event.metaKey) return;
    if (event.key in moves) {
      const last = this.#rows.length - 1;
      this.#activate(Math.min(last, Math.max(0, this.#active + moves[event.key])));
    } else if (!row) return;
    else if (event.key === "ArrowRight") this.#unfold(row);
    else if (event.key === "ArrowLeft") this.#fold(row);
    else if (event.key === "Enter" || event.key === " ") {
      this.#actions.select(this.#frames.names[row.k], event);
    } else return;
    event.preventDefault();
    event.stopPropagation();
  }
}
