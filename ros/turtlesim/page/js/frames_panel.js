// What TF knows: the tree of frames with rate and age, and where one frame is as another sees it.

import { transformInWords } from "./words.js";

const STALE_SECONDS = 1;
const MOST_FRAMES = 40;
const byId = (id) => document.getElementById(id);

export class FramesPanel {
  #onWatch;
  #shape = "";
  #readings = new Map();

  /** `onWatch({ target, source })` asks for the frames, `onWatch(null)` asks for them no longer. */
  constructor(onWatch) {
    this.#onWatch = onWatch;
    byId("frames").addEventListener("toggle", () => this.watch());
    for (const id of ["target", "source"]) byId(id).addEventListener("change", () => this.watch());
  }

  /** Say (again) what is wanted; a new connection knows nothing of it. */
  watch() {
    const chosen = { target: byId("target").value, source: byId("source").value };
    this.#onWatch(byId("frames").open ? chosen : null);
  }

  /** `message`: frames as [name, parent, rate or null, age or null], and the chosen relation. */
  show(message) {
    const frames = message.frames
      .slice(0, MOST_FRAMES)
      .map(([name, parent, rate, age]) => ({ name, parent, rate, age }));
    const shape = frames.map(({ name, parent }) => `${parent}/${name}`).join("\n");
    if (shape !== this.#shape) this.#rebuild(frames, message.frames.length);
    this.#shape = shape;
    for (const frame of frames) this.#showReading(frame);
    this.#showRelation(message);
  }

  #rebuild(frames, total) {
    const children = groupByParent(frames);
    const names = new Set(frames.map(({ name }) => name));
    const roots = [...children.keys()].filter((parent) => !names.has(parent));
    this.#readings.clear();
    byId("tree").replaceChildren(...roots.map((root) => this.#branch(root, children)));
    byId("no-frames").hidden = frames.length > 0;
    byId("relation").hidden = frames.length === 0;
    byId("more-frames").textContent = total > MOST_FRAMES ? `and ${total - MOST_FRAMES} more` : "";
    this.#offer([...roots, ...names].sort());
  }

  #branch(name, children) {
    const item = document.createElement("li");
    const label = document.createElement("span");
    const reading = document.createElement("small");
    label.textContent = name;
    item.append(label, reading);
    this.#readings.set(name, { item, reading });
    const below = children.get(name) ?? [];
    if (below.length) {
      const list = document.createElement("ul");
      list.append(...below.map((frame) => this.#branch(frame.name, children)));
      item.append(list);
    }
    return item;
  }

  #showReading({ name, rate, age }) {
    const { item, reading } = this.#readings.get(name) ?? {};
    if (!item) return; // a loop of parents has no root to hang from
    const isStale = age !== null && Math.abs(age) > STALE_SECONDS;
    item.dataset.kind = age === null ? "static" : isStale ? "stale" : "live";
    reading.textContent = age === null ? "static" : `${rate.toFixed(0)} Hz, ${ageInWords(age)}`;
  }

  /** Keep the user's choice; at first ask what the demo is about. */
  #offer(names) {
    for (const [id, wish] of [["target", "turtle2"], ["source", "turtle1"]]) {
      const select = byId(id);
      const chosen = [select.value, wish].find((name) => names.includes(name)) ?? names[0];
      const options = names.map((name) => new Option(name, name, false, name === chosen));
      select.replaceChildren(...options);
    }
    this.watch();
  }

  #showRelation({ target, source, relation }) {
    const words = byId("relation-words");
    const detail = byId("relation-detail");
    if (!relation) words.textContent = "";
    else words.textContent = relation.error || transformInWords(source, target, relation);
    words.toggleAttribute("data-error", Boolean(relation?.error));
    detail.textContent = !relation ? "" : relation.error ? relation.hint : numbers(relation);
  }
}

function numbers({ translation, rotation }) {
  const number = (value) => (value === null ? "not finite" : value.toFixed(3));
  const list = (values) => values.map(number).join(", ");
  return `translation ${list(translation)} · rotation xyzw ${list(rotation)}`;
}

function ageInWords(seconds) {
  if (seconds < -STALE_SECONDS) return `${(-seconds).toFixed(1)} s in the future`;
  if (seconds >= STALE_SECONDS) return `${seconds.toFixed(1)} s old`;
  return `${Math.max(0, 1000 * seconds).toFixed(0)} ms old`;
}

function groupByParent(frames) {
  const groups = new Map();
  for (const frame of frames) {
    groups.set(frame.parent, [...(groups.get(frame.parent) ?? []), frame]);
  }
  return groups;
}
