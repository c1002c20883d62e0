// The list of displays with their options, and the topics that can be added.
// A control for an option of a display, by the option's type.
// Check boxes for the named items of a display: namespaces of markers, links of a robot.

import { byId, make, setText } from "../kit/dom.js";
import { byName } from "../kit/names.js";
import { offer, setLine } from "./dom.js";

const MAKERS = {
  bool: (value, changed) => {
    const input = make("input", { type: "checkbox", checked: Boolean(value) });
    input.onchange = () => changed(input.checked);
    return input;
  },
  number: (value, changed, { min, max, step = "any" }) => {
    const input = make("input", { type: "number", value: String(value), step });
    if (min !== undefined) input.min = min;
    if (max !== undefined) input.max = max;
    input.onchange = () => {
      if (input.value !== "" && input.checkValidity()) changed(input.valueAsNumber);
      else input.reportValidity();
    };
    return input;
  },
  choice: (value, changed, { choices }) => {
    const input = make("select", {}, ...choices.map((choice) => new Option(choice, choice)));
    input.value = value;
    input.onchange = () => changed(input.value);
    return input;
  },
  color: (value, changed) => {
    const input = make("input", { type: "color", value });
    input.oninput = () => changed(input.value);
    return input;
  },
  text: (value, changed) => {
    const input = make("input", { type: "text", value: value ?? "", spellcheck: false });
    input.onchange = () => changed(input.value);
    return input;
  },
};

/** A label and its control; `changed(value)` when the user has chosen. */
export function optionControl(id, option, value, changed) {
  const control = (MAKERS[option.type] ?? MAKERS.text)(value, changed, option);
  control.id = id;
  const label = make("label", { textContent: option.label ?? option.name });
  label.htmlFor = id;
  return [label, control];
}

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

const MOST_OTHERS = 6;
/** A robot needs no topic: its description may be a parameter, or a file. */
const ROBOT = { kind: "robot_model", topic: "", options: { source: "parameter" } };
const ROBOT_OPTION = ["robot_model", "robot from a parameter or file"];
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
    byId("topic").addEventListener("change", allowAdding);
  }

  /** The server's topics, each with the kind of display that shows it, or null. */
  showTopics(topics) {
    this.#topics = [...topics].sort((a, b) => byName(a.name, b.name));
    const choices = this.#topics.flatMap(choicesOf);
    const options = choices.map(({ value, name, kind }) => {
      return [value, `${name} (${kindInWords(kind)})`];
    });
    const first = options.length ? options : [["", "No topic to draw"]];
    offer(byId("topic"), [...first, ROBOT_OPTION]);
    byId("topic").disabled = false;
    allowAdding();
    for (const { topics } of this.#items.values()) this.#offerTopics(topics);
    const others = this.#topics.filter(({ kind }) => !kind).map(({ name }) => name);
    const rest = others.length > MOST_OTHERS ? ` and ${others.length - MOST_OTHERS} more` : "";
    const list = others.slice(0, MOST_OTHERS).join(", ");
    setText(byId("other-topics"), others.length ? `No display shows: ${list}${rest}` : "");
  }

  /** Rebuild the list; items that stay keep their focus. */
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
    const chosen = this.#topics.flatMap(choicesOf)
      .find(({ value }) => value === byId("topic").value);
    if (chosen) this.#addOnce({ kind: chosen.kind, topic: chosen.name });
    else if (byId("topic").value === ROBOT_OPTION[0]) this.#addOnce(ROBOT);
  }

  /** Add a display, or point at the one that shows the same already. */
  #addOnce(wanted) {
    const there = this.#displays.list.find((each) => isSame(each, wanted));
    if (!there) return void this.#displays.add(wanted);
    if (!there.visible) this.#displays.setVisible(there.id, true);
    const { item } = this.#items.get(there.id);
    item.scrollIntoView({ block: "nearest" });
    item.querySelector(".eye").focus();
  }

  #showEntry(entry) {
    const shape = entry.schema.map(({ name }) => name).join();
    let known = this.#items.get(entry.id);
    if (!known || known.shape !== shape) {
      const made = { ...this.#makeItem(entry), shape };
      if (known) known.item.replaceWith(made.item);
      else byId("display-list").append(made.item);
      known = made;
      this.#items.set(entry.id, known);
    }
    const { item, lists } = known;
    for (const [name, list] of lists) list.show(entry.items?.[name] ?? []);
    setText(item.querySelector(".title b"), entry.topic || kindInWords(entry.kind));
    const text = entry.text || entry.problem || "";
    item.dataset.level = entry.text ? entry.level : entry.problem ? "warn" : "ok";
    item.querySelector(".eye").setAttribute("aria-pressed", String(!entry.visible));
    setLine(item.querySelector(".status"), text);
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
      make("div", {}, eye, title, remove), make("div", { className: "status" }));
    if (!schema.length) return { item, lists: [], topics: null };
    const topics = make("datalist", { id: `${id}-topics` });
    topics.dataset.kind = kind;
    const lists = [];
    const set = make("fieldset", {}, ...this.#topicControl(entry, topics));
    for (const option of schema) set.append(...this.#control(entry, option, lists));
    item.append(make("details", {}, make("summary", { textContent: "Options" }), set));
    return { item, lists, topics };
  }

  /** A label and a control; lists of items are kept, for their items come later. */
  #control({ id, options }, option, lists) {
    if (option.hidden) return [];
    const value = options[option.name] ?? option.value;
    const change = (chosen) => this.#displays.setOption(id, option.name, chosen);
    if (option.type !== "items") {
      return optionControl(`${id}-${option.name}`, option, value, change);
    }
    const list = new ItemList(option, value, change);
    lists.push([option.name, list]);
    return [make("span", { textContent: option.label }), list.element];
  }

  #topicControl({ id, topic }, topics) {
    const input = make("input", { type: "text", id: `${id}-topic`, value: topic });
    input.setAttribute("list", topics.id);
    input.spellcheck = false;
    input.onchange = () => this.#displays.setTopic(id, input.value.trim());
    const label = make("label", { textContent: "Topic" });
    label.htmlFor = input.id;
    this.#offerTopics(topics);
    return [label, input, topics];
  }

  #offerTopics(list) {
    if (!list) return;
    const names = this.#topics.flatMap(choicesOf).filter(({ kind }) => kind === list.dataset.kind);
    list.replaceChildren(...names.map(({ name }) => new Option(name)));
  }
}

/** What can be added of a topic: { value, name, kind } of each display that shows it. */
function choicesOf({ name, kind, others = [] }) {
  const usual = kind ? [{ value: name, name, kind }] : [];
  return [...usual, ...others.map((each) => ({ value: `${each} ${name}`, name, kind: each }))];
}

function allowAdding() {
  byId("add-display").disabled = byId("topic").value === "";
}

/** A robot without a topic is another one when it comes from another parameter, or a file. */
function isSame({ kind, topic, options, schema }, wanted) {
  if (kind !== wanted.kind || topic !== wanted.topic) return false;
  if (topic) return true;
  const isMoved = schema.some(({ name, value }) => {
    return (name === "node" || name === "parameter") && options[name] !== value;
  });
  return options.source === wanted.options.source && !isMoved;
}

/** "point_cloud" as "point cloud". */
function kindInWords(kind) {
  return kind.replaceAll("_", " ");
}
