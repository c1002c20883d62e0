// What TF knows: the tree of frames with rate and age, and where one frame is as another sees it.

import { byId } from "../kit/dom.js";
import { byName, isFound } from "../kit/names.js";
import { transformInWords } from "./words.js";

const STALE_SECONDS = 1;
const MOST_FRAMES = 200;
const FEW = 8; // a number that users see at a glance

export class FramesPanel {
  #onWatch;
  #shape = "";
  #readings = new Map();
  #chosen = { source: null, target: null }; // by the user; null: what the page proposes

  /** Whether the frames are drawn on the field. */
  drawn = true;
  /** The arrow from the frame that sees to the frame that is seen, null without one. */
  arrow = { from: null, to: null };

  /**
   * `onWatch({ target, source, axes })` asks for the frames, `onWatch(null)` asks for them no
   * longer.
   */
  constructor(onWatch) {
    this.#onWatch = onWatch;
    byId("frames").addEventListener("toggle", () => this.watch());
    byId("find-frame").addEventListener("input", () => (this.#shape = null));
    for (const id of ["target", "source"]) {
      byId(id).addEventListener("change", ({ target }) => {
        this.#chosen[id] = target.value;
        this.watch();
      });
    }
  }

  /** Say (again) what is wanted; a new connection knows nothing of it. */
  watch() {
    const isOpen = byId("frames").open;
    if (!isOpen) this.#showRelation({ relation: null });
    const wanted = (id) => (isOpen ? byId(id).value : "");
    const watch = { target: wanted("target"), source: wanted("source"), axes: this.drawn };
    this.#onWatch(isOpen || this.drawn ? watch : null);
  }

  /** Draw the frames on the field, or draw them no longer. */
  draw(on) {
    this.drawn = on;
    this.watch();
  }

  /** `message`: frames as [name, parent, rate or null, age or null], and the chosen relation. */
  show(message) {
    const frames = message.frames.map(([name, parent, rate, age]) => ({ name, parent, rate, age }));
    const search = byId("find-frame").value;
    const shape = frames.map(({ name, parent }) => `${parent}/${name}`).join("\n");
    if (shape !== this.#shape) this.#rebuild(frames, search);
    this.#shape = shape;
    for (const frame of frames) this.#showReading(frame);
    this.#showRelation(message);
  }

  #rebuild(frames, search) {
    const all = [...new Set(frames.flatMap(({ name, parent }) => [parent, name]))].sort(byName);
    const shown = withParents(frames, all.filter((name) => isFound(name, search)));
    const children = groupByParent(frames.filter(({ name }) => shown.has(name)));
    const named = new Set(frames.map(({ name }) => name));
    const roots = all.filter((name) => !named.has(name));
    const branches = roots.filter((root) => shown.has(root));
    this.#readings.clear();
    byId("tree").replaceChildren(...branches.map((root) => this.#branch(root, children)));
    byId("no-frames").hidden = frames.length > 0;
    byId("find-frame").hidden = all.length <= FEW && !search;
    const hidden = all.length - this.#readings.size;
    const rest = search ? `${hidden} hidden` : `and ${hidden} more`;
    byId("more-frames").textContent = hidden ? rest : "";
    this.#offer(all, roots);
  }

  #branch(name, children) {
    const item = document.createElement("li");
    const label = document.createElement("span");
    const reading = document.createElement("small");
    label.textContent = name;
    item.append(label, reading);
    this.#readings.set(name, { item, reading });
    const room = Math.max(0, MOST_FRAMES - this.#readings.size);
    const below = (children.get(name) ?? []).slice(0, room);
    if (below.length) {
      const list = document.createElement("ul");
      list.append(...below.map((child) => this.#branch(child, children)));
      item.append(list);
    }
    return item;
  }

  #showReading({ name, rate, age }) {
    const { item, reading } = this.#readings.get(name) ?? {};
    if (!item) return; // not sought, or in a loop of parents, which has no root to hang from
    const isStale = age !== null && Math.abs(age) > STALE_SECONDS;
    item.dataset.kind = age === null ? "static" : isStale ? "stale" : "live";
    reading.textContent = age === null ? "static" : `${rate.toFixed(0)} Hz, ${ageInWords(age)}`;
  }

  /**
   * Keep the user's choice. Until there is one, ask what the demo is about: where turtle1 is as
   * turtle2 sees it, or as the world does while there is no turtle2.
   */
  #offer(names, roots) {
    const { source, target } = this.#chosen;
    const pick = (chosen, wishes, other) =>
      names.includes(chosen)
        ? chosen
        : wishes.find((name) => names.includes(name) && name !== other);
    const children = names.filter((name) => !roots.includes(name));
    const seen = pick(source, ["turtle1", ...children], target);
    const seeing = pick(target, ["turtle2", ...roots, ...names], seen);
    for (const [id, wanted] of [["source", seen], ["target", seeing]]) {
      byId(id).replaceChildren(
        ...names.map((name) => new Option(name, name, false, name === wanted)),
      );
    }
    this.watch();
  }

  #showRelation({ target, source, relation }) {
    const words = byId("relation-words");
    const detail = byId("relation-detail");
    byId("relation").hidden = !relation;
    const isFound = relation && !relation.error;
    this.arrow = isFound ? { from: target, to: source } : { from: null, to: null };
    if (!relation) return;
    words.textContent = relation.error || transformInWords(source, target, relation);
    words.toggleAttribute("data-error", Boolean(relation.error));
    detail.replaceChildren(...(relation.error ? [relation.hint] : numbers(relation)).map(inSpan));
  }
}

function numbers({ translation, rotation }) {
  const unsigned = (text) => (text === "-0.000" ? "0.000" : text);
  const number = (value) => (value === null ? "not finite" : unsigned(value.toFixed(3)));
  const list = (values) => values.map(number).join(", ");
  return [`translation ${list(translation)}`, `rotation xyzw ${list(rotation)}`];
}

function inSpan(text) {
  const span = document.createElement("span");
  span.textContent = text;
  return span;
}

function ageInWords(seconds) {
  if (seconds < -STALE_SECONDS) return `${(-seconds).toFixed(1)} s in the future`;
  if (seconds >= STALE_SECONDS) return `${seconds.toFixed(1)} s old`;
  return `${Math.max(0, 1000 * seconds).toFixed(0)} ms old`;
}

/** The names, and all frames above them, so that each hangs from its root. */
function withParents(frames, names) {
  const parents = new Map(frames.map(({ name, parent }) => [name, parent]));
  const shown = new Set();
  for (let name of names) {
    for (; name !== undefined && !shown.has(name); name = parents.get(name)) shown.add(name);
  }
  return shown;
}

/** Parent to the names of its children, in their natural order. */
function groupByParent(frames) {
  const groups = new Map();
  for (const { name, parent } of frames) groups.set(parent, [...(groups.get(parent) ?? []), name]);
  for (const names of groups.values()) names.sort(byName);
  return groups;
}
