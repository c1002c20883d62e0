// Which frames the user does not want to see: by a regular expression, or one by one.

import { byId, setText } from "../kit/dom.js";

export class Hiding {
  #pattern = null;
  #chosen = new Map(); // name to hidden or not: stronger than the pattern
  #onChange;

  /** `onChange()`: apply to the frames again. */
  constructor(onChange) {
    this.#onChange = onChange;
    byId("hide").addEventListener("input", ({ target }) => this.#take(target.value));
  }

  /** Hide or show one frame. */
  set(name, hidden) {
    this.#chosen.set(name, hidden);
    this.#onChange();
  }

  /** Write `frames.hidden`. */
  apply(frames) {
    frames.names.forEach((name, k) => {
      frames.hidden[k] = (this.#chosen.get(name) ?? this.#pattern?.test(name) ?? false) ? 1 : 0;
    });
  }

  #take(text) {
    let problem = "";
    try {
      this.#pattern = text ? new RegExp(text) : null;
    } catch (error) {
      problem = `${error.message}.`;
    }
    byId("hide").setAttribute("aria-invalid", String(problem !== ""));
    byId("hide-problem").hidden = problem === "";
    setText(byId("hide-problem"), problem);
    if (!problem) this.#onChange();
  }
}
