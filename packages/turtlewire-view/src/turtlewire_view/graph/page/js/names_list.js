// All nodes and topics as a list that can be searched, for eyes, keys and screen readers.

import { byId, make, setText } from "../kit/dom.js";
import { byName, isFound } from "../kit/names.js";
import { keyOf, partsOf } from "./graph_model.js";

export class NamesList {
  #model;
  #choose;
  #list = byId("list");
  #keys = [];
  #shape = "";
  #selected = "";
  #active = "";

  /** `choose(key)` is called when the user chooses a name. */
  constructor(model, choose) {
    this.#model = model;
    this.#choose = choose;
    byId("search").addEventListener("input", () => this.show());
    byId("search").addEventListener("keydown", (event) => {
      if (event.key === "Enter" && this.#keys.length) choose(this.#keys[0]);
      if (event.key === "ArrowDown") this.#list.focus();
    });
    this.#list.addEventListener("click", ({ target }) => {
      const row = target.closest("li");
      if (row) choose(row.dataset.key);
    });
    this.#list.addEventListener("keydown", (event) => this.#key(event));
    this.#list.addEventListener("focus", () => {
      // A press must not scroll the list, or it hits another row.
      if (this.#list.matches(":focus-visible")) this.#activate(this.#active || this.#keys[0]);
    });
  }

  /** Show the names that the search finds. */
  show() {
    const { graph, names } = this.#model;
    const search = byId("search").value.trim();
    const found = names.filter(([, name]) => isFound(name, search));
    found.sort(([kind, a], [other, b]) => (kind === other ? byName(a, b) : kind < other ? -1 : 1));
    const bad = new Set(graph.mismatches.flatMap(({ topic, publishers, subscriptions }) => {
      const nodes = [...publishers, ...subscriptions];
      return [keyOf("topic", topic), ...nodes.map((each) => keyOf("node", each))];
    }));
    this.#keys = found.map(([kind, name]) => keyOf(kind, name));
    const rows = this.#keys.map((key, k) => this.#row(key, k, bad.has(key)));
    const shape = rows.map(({ ariaLabel }) => ariaLabel).join("\n");
    if (shape !== this.#shape) this.#list.replaceChildren(...rows); // a row may just be pressed
    this.#shape = shape;
    setText(byId("name-count"), names.length ? String(names.length) : "");
    byId("nothing").hidden = found.length > 0;
    setText(byId("nothing"), names.length ? "No name matches." : "No node is running.");
    this.select(this.#selected);
  }

  /** Mark a name, and scroll to it. */
  select(key) {
    const isNew = key !== this.#selected;
    this.#selected = key;
    for (const row of this.#list.children) {
      row.setAttribute("aria-selected", String(row.dataset.key === key));
    }
    if (isNew && this.#keys.includes(key)) this.#activate(key);
  }

  #row(key, k, isBad) {
    const [kind, name] = partsOf(key);
    const row = make("li", { id: `name-${k}`, className: kind, textContent: name, title: name });
    row.setAttribute("role", "option");
    row.setAttribute("aria-label", `${kind} ${name}${isBad ? ", mismatch" : ""}`);
    row.dataset.key = key;
    row.toggleAttribute("data-bad", isBad);
    return row;
  }

  #activate(key) {
    const row = this.#list.children[this.#keys.indexOf(key)];
    if (!row) return;
    this.#list.querySelector("[data-active]")?.removeAttribute("data-active");
    row.setAttribute("data-active", "");
    this.#active = key;
    this.#list.setAttribute("aria-activedescendant", row.id);
    const { offsetTop, offsetHeight } = row; // the page itself must not scroll
    const { scrollTop, clientHeight } = this.#list;
    if (offsetTop < scrollTop) this.#list.scrollTop = offsetTop;
    const below = offsetTop + offsetHeight - clientHeight;
    if (below > scrollTop) this.#list.scrollTop = below;
  }

  #key(event) {
    const last = this.#keys.length - 1;
    const at = this.#keys.indexOf(this.#active);
    const page = 10;
    const places = {
      ArrowDown: at + 1,
      ArrowUp: at - 1,
      PageDown: at + page,
      PageUp: at - page,
      Home: 0,
      End: last,
    };
    if (event.key in places) {
      this.#activate(this.#keys[Math.min(Math.max(places[event.key], 0), last)]);
    } else if ((event.key === "Enter" || event.key === " ") && this.#active) {
      this.#choose(this.#active);
    } else return;
    event.preventDefault();
    event.stopPropagation();
  }
}
