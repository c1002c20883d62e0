// The pose of one frame in another: the sentence, the numbers, or the reason why it is unknown.

import { byId, make, setFacts, setText } from "../kit/dom.js";
import { byName } from "../kit/names.js";
import { offer, setLine } from "./dom.js";
import {
  ageInWords, delayInWords, fixed, isNumber, numbersInWords, publisherInWords, rateInWords,
} from "./words.js";

const FIXED = ""; // the target that is always the fixed frame
const MATRIX_ROWS = ["x", "y", "z", "last row"];
const ASK = "Select a frame in the 3D view or in the tree.";

export class RelationPanel {
  #frames;
  #onChoose;
  #source = "";
  #target = FIXED;

  /** `onChoose()`: the user chose other frames; see `source` and `target`. */
  constructor(frames, onChoose) {
    this.#frames = frames;
    this.#onChoose = onChoose;
    byId("relation-source").onchange = ({ target }) => this.choose(target.value, this.#target);
    byId("relation-target").onchange = ({ target }) => this.choose(this.#source, target.value);
    byId("swap").onclick = () => this.choose(this.target, this.#source);
    this.#showEmpty();
  }

  /** The frame looked at, "" for none. */
  get source() {
    return this.#source;
  }

  /** The frame that looks. */
  get target() {
    return this.#target === FIXED ? this.#frames.fixed : this.#target;
  }

  /** Choose both; the target "" is the current fixed frame. */
  choose(source, target = FIXED) {
    this.#source = source;
    this.#target = target;
    this.rebuild();
    byId("help").hidden = Boolean(source);
    if (!source) this.#showEmpty();
    this.#onChoose();
  }

  /** Choose the frame that looks, at the one that is selected. */
  chooseTarget(target) {
    this.choose(this.#source, target);
  }

  /** Other names. */
  rebuild() {
    const names = [...this.#frames.names].sort(byName).map((name) => [name, name]);
    const { fixed } = this.#frames;
    offer(byId("relation-source"), [["", "…"], ...this.#withGone(this.#source, names)],
      this.#source);
    const targets = [[FIXED, fixed || "the fixed frame"], ...names.filter(([n]) => n !== fixed)];
    offer(byId("relation-target"), this.#withGone(this.#target, targets), this.#target);
    byId("swap").disabled = !this.#source;
  }

  /** The server's answer. */
  show(relation) {
    if (relation.source !== this.#source || relation.target !== this.target) return;
    const sentence = byId("sentence");
    sentence.toggleAttribute("data-error", Boolean(relation.error));
    sentence.removeAttribute("data-empty");
    if (relation.error) setLine(sentence, relation.error);
    else setText(sentence, relation.sentence || "");
    setText(byId("hint"), relation.error ? (relation.hint ?? "") : "");
    byId("hint").hidden = !byId("hint").textContent;
    byId("numbers").hidden = Boolean(relation.error);
    if (!relation.error) this.#showNumbers(relation);
  }

  /** The tree's data about the selected frame. */
  showFacts(row) {
    if (!this.#source || !row) return setFacts(byId("facts"), []);
    const k = this.#frames.index(this.#source);
    const isMoving = row.parent && !row.static;
    setFacts(byId("facts"), [
      ["parent", this.#frames.names[this.#frames.parents[k]] ?? "none, it is a root"],
      ["published by", row.publisher ? publisherInWords(row) : null],
      ["rate", row.static ? "static" : isNumber(row.rate) ? rateInWords(row.rate) : null],
      ["age", isMoving && isNumber(row.age) ? ageInWords(row.age) : null],
      ["delay", isMoving && isNumber(row.delay) ? delayInWords(row.delay) : null],
      ["samples", isMoving && isNumber(row.samples) ? String(row.samples) : null],
    ]);
  }

  #withGone(name, options) {
    const isThere = !name || options.some(([value]) => value === name);
    return isThere ? options : [...options, [name, `${name} (gone)`]];
  }

  #showEmpty() {
    setText(byId("sentence"), ASK);
    byId("sentence").removeAttribute("data-error");
    byId("sentence").setAttribute("data-empty", "");
    byId("hint").hidden = true;
    byId("numbers").hidden = true;
    setFacts(byId("facts"), []);
  }

  #showNumbers({ translation, rotation, rpy, matrix }) {
    const degrees = rpy.map((angle) => (isNumber(angle) ? (180 * angle) / Math.PI : angle));
    setFacts(byId("number-list"), [
      ["translation", `${numbersInWords(translation)} m`],
      ["rotation xyzw", numbersInWords(rotation)],
      ["roll pitch yaw", `${numbersInWords(rpy)} rad`],
      ["in degrees", numbersInWords(degrees, 1)],
    ]);
    const cells = byId("matrix").querySelectorAll("td");
    const values = matrix.flat().map((value) => (isNumber(value) ? fixed(value, 3) : "nan"));
    if (cells.length === values.length) {
      return cells.forEach((cell, n) => setText(cell, values[n]));
    }
    byId("matrix").tBodies[0].replaceChildren(...matrix.map((row, r) => make("tr", {},
      make("th", { scope: "row", className: "unseen", textContent: MATRIX_ROWS[r] }),
      ...row.map((_, c) => make("td", { textContent: values[4 * r + c] })))));
  }
}
