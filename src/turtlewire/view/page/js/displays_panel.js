// The list of displays with their options, and the topics that can be added.

import { byId, make, naturalOrder, offer, setText } from "./dom.js";
import { optionControl } from "./option_controls.js";

const MOST_OTHERS = 6;
const EYE = '<svg viewBox="0 0 24 24" aria-hidden="true"><path class="lid" '
  + 'd="M2 12s4-6 10-6 10 6 10 6-4 6-10 6S2 12 2 12zM12 9a3 3 0 1 0 .01 0"/>'
  + '<path class="slash" d="M3 12c4 5 14 5 18 0M6 16l-2 3M12 17v3M18 16l2 3"/></svg>';

export class DisplaysPanel {
  #displays;
  #topics = [];
  #items = new Map(); // id to { item, shape }

  constructor(displays) {
    this.#displays = displays;
    byId("add-display").onclick = () => this.#add();
  }

  /** The server's topics, each with the kind of display that shows it, or null. */
  showTopics(topics) {
    this.#topics = [...topics].sort((a, b) => naturalOrder(a.name, b.name));
    const shown = this.#topics.filter(({ kind }) => kind);
    const options = shown.map(({ name, kind }) => [name, `${name} (${kindInWords(kind)})`]);
    const isEmpty = options.length === 0;
    offer(byId("topic"), isEmpty ? [["", "No topic that can be drawn"]] : options);
    byId("topic").disabled = byId("add-display").disabled = isEmpty;
    const others = this.#topics.filter(({ kind }) => !kind).map(({ name }) => name);
    const rest = others.length > MOST_OTHERS ? ` and ${others.length - MOST_OTHERS} more` : "";
    const list = others.slice(0, MOST_OTHERS).join(", ");
    setText(byId("other-topics"), others.length ? `Without a picture: ${list}${rest}` : "");
  }

  /** The list anew; items that stay keep their focus. */
  show() {
    const list = this.#displays.list;
    const ids = new Set(list.map(({ id }) => id));
    for (const [id, { item }] of this.#items) {
      if (ids.has(id)) continue;
      item.remove();
      this.#items.delete(id);
    }
    for (const entry of list) this.#showEntry(entry);
  }

  #add() {
    const topic = this.#topics.find(({ name }) => name === byId("topic").value);
    if (topic?.kind) this.#displays.add({ kind: topic.kind, topic: topic.name });
  }

  #showEntry(entry) {
    const shape = entry.schema.map(({ name }) => name).join();
    let known = this.#items.get(entry.id);
    if (!known || known.shape !== shape) {
      const item = this.#makeItem(entry);
      if (known) known.item.replaceWith(item);
      else byId("display-list").append(item);
      known = { item, shape };
      this.#items.set(entry.id, known);
    }
    const { item } = known;
    const text = entry.text || entry.problem || "";
    item.dataset.level = entry.text ? entry.level : entry.problem ? "warn" : "ok";
    item.querySelector(".eye").setAttribute("aria-pressed", String(!entry.visible));
    setText(item.querySelector(".status"), text);
    item.querySelector(".status").hidden = !text;
  }

  #makeItem(entry) {
    const { id, kind, topic, schema } = entry;
    const name = topic || kindInWords(kind);
    const eye = make("button", { type: "button", className: "eye", title: "Hide or show" });
    eye.setAttribute("aria-label", `Hide ${name}`);
    eye.innerHTML = EYE;
    eye.onclick = () => this.#displays.setVisible(id, !entry.visible);
    const remove = make("button", {
      type: "button", className: "remove", textContent: "✕", title: "Remove",
    });
    remove.setAttribute("aria-label", `Remove ${name}`);
    remove.onclick = () => this.#displays.remove(id);
    const title = make("span", { className: "title" },
      make("b", { textContent: name }), make("small", { textContent: kindInWords(kind) }));
    const item = make("li", { className: "display" },
      make("div", {}, eye, title, remove), make("p", { className: "status" }));
    if (schema.length) item.append(this.#options(entry));
    return item;
  }

  #options({ id, schema, options }) {
    const set = make("fieldset");
    for (const option of schema) {
      const value = options[option.name] ?? option.value;
      const change = (chosen) => this.#displays.setOption(id, option.name, chosen);
      set.append(...optionControl(`${id}-${option.name}`, option, value, change));
    }
    return make("details", {}, make("summary", { textContent: "Options" }), set);
  }
}

/** "point_cloud" as "point cloud". */
function kindInWords(kind) {
  return kind.replaceAll("_", " ");
}
