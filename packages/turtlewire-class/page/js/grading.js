// The checks of a lesson: one line for each, with what was seen and what helps.

import { byId } from "../kit/dom.js";

const TRIES_BEFORE_SOLUTION = 2;

export class Grading {
  #failures = 0;
  #results = [];

  /** `check()` and `showSolution()` are called when the buttons are pressed. */
  constructor(check, showSolution) {
    byId("check").onclick = async () => {
      byId("check").disabled = true;
      this.#empty();
      try {
        await check();
      } finally {
        byId("check").disabled = false;
      }
    };
    byId("solution").onclick = showSolution;
  }

  /** Another lesson. */
  clear() {
    this.#failures = 0;
    byId("solution").hidden = true;
    this.#empty();
  }

  #empty() {
    this.#results = [];
    byId("results").replaceChildren();
    byId("verdict").hidden = true;
  }

  add(result) {
    this.#results.push(result);
    const item = document.createElement("li");
    item.dataset.passed = result.passed ? "yes" : "no";
    const parts = [["strong", result.check], ["span", result.text], ["em", result.hint]];
    for (const [tag, text] of parts) {
      if (!text) continue;
      const part = document.createElement(tag);
      part.textContent = text;
      item.append(part);
    }
    byId("results").append(item);
  }

  /** All results are there; whether the task is solved. `next` is the next lesson, if any. */
  finish(next) {
    const isSolved = this.#results.length > 0 && this.#results.every(({ passed }) => passed);
    const verdict = byId("verdict");
    verdict.hidden = !isSolved;
    verdict.textContent = "Solved. The same files run with ros2 launch on a robot. ";
    if (next) {
      const link = document.createElement("a");
      link.href = `#${next.id}`;
      link.textContent = `Next: ${next.title}`;
      verdict.append(link);
    }
    if (!isSolved) this.#failures += 1;
    byId("solution").hidden = isSolved || this.#failures < TRIES_BEFORE_SOLUTION;
    return isSolved;
  }
}
