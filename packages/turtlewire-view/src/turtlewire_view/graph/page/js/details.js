// The selected node or topic: its endpoints with their QoS, mismatches, rate and last message; and
// numbers and policies as people read them.

import { byId, make, setFacts, setText } from "../kit/dom.js";
import { keyOf, partsOf } from "./graph_model.js";

export class Details {
  #model;
  #actions;
  #key = "";
  #shape = "";
  #facts = make("dl");
  #note = make("p", { className: "note" });
  #value = make("pre", { tabIndex: 0 });

  /** `actions`: choose(key), pin(topic), isPinned(topic). */
  constructor(model, actions) {
    this.#model = model;
    this.#actions = actions;
    this.#value.setAttribute("aria-label", "Last message");
  }

  /** Show a node or topic; "" for none. */
  show(key) {
    const [kind, name] = partsOf(key);
    const parts = key ? (kind === "topic" ? this.#topic(name) : this.#node(name)) : [];
    const isPinned = key && this.#actions.isPinned(name);
    const shape = JSON.stringify([key, parts.map(({ outerHTML }) => outerHTML), isPinned]);
    if (shape === this.#shape) return; // what has the focus keeps it
    this.#shape = shape;
    byId("help").hidden = Boolean(key);
    byId("selected").hidden = !key;
    if (key !== this.#key) this.showReading(null);
    this.#key = key;
    byId("selected").replaceChildren(...parts);
  }

  /** The server's reading of the selected topic, or null. */
  showReading(reading) {
    const { rate, bandwidth, age } = reading ?? {};
    setFacts(this.#facts, [
      ["rate", reading ? (rate === null ? "–" : rateInWords(rate)) : "…"],
      ["bandwidth", reading ? (bandwidth === null ? "–" : bandwidthInWords(bandwidth)) : "…"],
      ["last message", age > 2 ? `${age.toFixed(0)} s ago` : null],
    ]);
    setText(this.#note, reading?.note ?? "");
    this.#note.hidden = !reading?.note;
    setText(this.#value, reading?.value ?? "");
    this.#value.hidden = !reading?.value;
  }

  #topic(name) {
    const topic = this.#model.graph.topics.find((each) => each.topic === name);
    const types = make("p", { className: "types" }, ...(topic?.types ?? ["gone"]).map((type) => {
      return make("code", { textContent: type });
    }));
    const isPinned = this.#actions.isPinned(name);
    const pin = make("button", { type: "button", id: "pin", textContent: "Keep rate" });
    pin.title = "Keep showing the rate in the picture when you select something else";
    pin.setAttribute("aria-pressed", String(isPinned));
    pin.onclick = () => this.#actions.pin(name);
    const head = make("p", { className: "title" }, make("b", { textContent: name }), pin);
    const live = make("div", {}, this.#facts, this.#note, this.#value);
    return [
      head, types, ...this.#problems("topic", name), live,
      ...this.#endpoints("Publishers", "topic", name, "publisher"),
      ...this.#endpoints("Subscriptions", "topic", name, "subscription"),
    ];
  }

  #node(name) {
    const box = this.#model.box(keyOf("node", name));
    const note = box?.note ?? "This node is gone.";
    const head = make("p", { className: "title" }, make("b", { textContent: name }));
    return [
      head, ...(note ? [make("p", { className: "bad", textContent: `${note}.` })] : []),
      ...this.#problems("node", name),
      ...this.#endpoints("Publishes", "node", name, "publisher"),
      ...this.#endpoints("Subscribes to", "node", name, "subscription"),
    ];
  }

  #problems(kind, name) {
    return this.#model.mismatches(kind, name).map((each) => {
      return make("p", { className: "bad", textContent: mismatchInWords(each) });
    });
  }

  #endpoints(title, kind, name, side) {
    const ends = this.#model.endpoints(kind, name, side);
    const other = kind === "topic" ? "node" : "topic";
    const rows = ends.map((end) => {
      const text = end[other] ?? "(unknown node)";
      const button = make("button", { type: "button", className: "link", textContent: text });
      button.onclick = () => this.#actions.choose(keyOf(other, text));
      return make("li", {}, button, make("small", { textContent: qosInWords(end.qos) }));
    });
    const none = make("p", { className: "note", textContent: "none" });
    return [make("h3", { textContent: title }), rows.length ? make("ul", {}, ...rows) : none];
  }
}

/** The sentence about endpoints that do not connect. */
export function mismatchInWords({ topic, reason, publishers, subscriptions }) {
  const [senders, receivers] = [publishers, subscriptions].map(namesInWords);
  const verb = subscriptions.length > 1 ? "receive" : "receives";
  return `${topic}: ${receivers} ${verb} nothing from ${senders}: ${reason}.`;
}

function namesInWords(names) {
  const shown = names.slice(0, 3).map((name) => name ?? "an unknown node").join(", ");
  return names.length > 3 ? `${shown} and ${names.length - 3} more` : shown;
}

/** 0.5 Hz, 62.5 Hz, 1000 Hz. */
export function rateInWords(rate) {
  return `${rate.toFixed(rate < 99.95 ? 1 : 0)} Hz`;
}

/** 512 B/s, 1.2 kB/s, 30 MB/s. */
function bandwidthInWords(bytes) {
  const units = ["B/s", "kB/s", "MB/s", "GB/s"];
  const power = Math.min(3, Math.max(0, Math.floor(Math.log10(Math.max(bytes, 1)) / 3)));
  const number = bytes / 1000 ** power;
  return `${number.toFixed(power && number < 9.95 ? 1 : 0)} ${units[power]}`;
}

/** Only what is not as in ROS 2's default profile stands behind the first two. */
function qosInWords(qos) {
  const words = [qos.reliability, qos.durability].map((word) => word.replaceAll("_", " "));
  words.push(qos.depth === null ? qos.history.replaceAll("_", " ") : `depth ${qos.depth}`);
  if (qos.deadline_ns) words.push(`deadline ${qos.deadline_ns / 1e9} s`);
  if (qos.lifespan_ns) words.push(`lifespan ${qos.lifespan_ns / 1e9} s`);
  if (qos.liveliness === "manual_by_topic") words.push("liveliness manual by topic");
  if (qos.liveliness_lease_duration_ns) {
    words.push(`lease ${qos.liveliness_lease_duration_ns / 1e9} s`);
  }
  return words.join(" · ");
}

/** "1 node", "2 nodes". */
export function count(number, word) {
  return `${number} ${word}${number === 1 ? "" : number && word.endsWith("h") ? "es" : "s"}`;
}
