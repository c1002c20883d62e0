// Check boxes for the named items of a display: namespaces of markers, links of a robot.

import { make } from "../kit/dom.js";
import { byName } from "../kit/names.js";

export class ItemList {
  element = make("div", { className: "items" });
  #value;
  #hasAlpha;
  #greatest; // label of a number that each item may have, or undefined
  #changed;
  #names = "";
  #allBox = null;

  /** `value`: name to { shown, alpha, max }; `changed(value)` when the user has chosen. */
  constructor({ alpha, max, label }, value, changed) {
    this.#value = value;
    this.#hasAlpha = alpha;
    this.#greatest = max;
    this.#changed = changed;
    this.element.setAttribute("role", "group");
    this.element.setAttribute("aria-label", label);
    this.show([]);
  }

  /** One line for each name, and one for all. */
  show(names) {
    const sorted = [...names].sort(byName);
    const key = JSON.stringify(sorted);
    if (key === this.#names) return;
    this.#names = key;
    const rows = sorted.map((name) => this.#row(name));
    if (sorted.length > 1) rows.unshift(this.#all(sorted));
    this.element.replaceChildren(...rows);
    if (!sorted.length) this.element.textContent = "none yet";
  }

  #row(name) {
    const { shown = true, alpha = 1 } = this.#value[name] ?? {};
    const box = make("input", { type: "checkbox", checked: shown });
    box.onchange = () => this.#set({ [name]: { ...this.#value[name], shown: box.checked } });
    const row = make("div", {}, make("label", {}, box, name || "(no name)"));
    if (this.#hasAlpha) {
      const look = { type: "range", min: "0", max: "1", step: "0.05", value: String(alpha) };
      const slider = make("input", look);
      slider.setAttribute("aria-label", `Alpha of ${name}`);
      slider.oninput = () => {
        this.#set({ [name]: { ...this.#value[name], alpha: slider.valueAsNumber } });
      };
      row.append(slider);
    }
    if (this.#greatest) row.append(this.#number(name));
    return row;
  }

  /** The greatest value of an item; an empty one is the item's own. */
  #number(name) {
    const { max } = this.#value[name] ?? {};
    const look = { type: "number", min: "0", step: "any", value: max ?? "", placeholder: "max" };
    const input = make("input", look);
    input.setAttribute("aria-label", `${this.#greatest} of ${name}`);
    input.title = this.#greatest;
    input.onchange = () => {
      if (!input.reportValidity()) return;
      const { max: _, ...others } = this.#value[name] ?? {};
      const own = input.value === "" ? {} : { max: input.valueAsNumber };
      this.#set({ [name]: { ...others, ...own } });
    };
    return input;
  }

  #all(names) {
    const box = this.#allBox = make("input", { type: "checkbox" });
    this.#showAll(names);
    box.onchange = () => {
      this.#set(Object.fromEntries(names.map((name) => {
        return [name, { ...this.#value[name], shown: box.checked }];
      })));
      for (const each of this.element.querySelectorAll("label > input")) {
        each.checked = box.checked;
      }
    };
    return make("div", {}, make("label", {}, box, "All"));
  }

  #showAll(names) {
    const shown = names.filter((name) => this.#value[name]?.shown !== false).length;
    this.#allBox.checked = shown === names.length;
    this.#allBox.indeterminate = shown > 0 && shown < names.length;
  }

  #set(changes) {
    this.#value = { ...this.#value, ...changes };
    if (this.#allBox) this.#showAll(JSON.parse(this.#names));
    this.#changed(this.#value);
  }
}
