// What the server said of the graph, so that the picture and the lists find it by name.

const NO_GRAPH = { nodes: [], topics: [], endpoints: [], mismatches: [] };

export class GraphModel {
  boxes = []; // { key, kind, name, note, x, y, width, height, label }
  arrows = []; // { source, target, topics, mismatches, path, x, y }, the first two are boxes
  graph = NO_GRAPH;
  width = 0;
  height = 0;
  #byKey = new Map();

  /** Take the server's message. */
  take({ boxes, arrows, graph, width, height }) {
    this.boxes = boxes.map(([kind, name, note, x, y, boxWidth, boxHeight, label]) => {
      const size = { width: boxWidth, height: boxHeight };
      return { key: keyOf(kind, name), kind, name, note, x, y, ...size, label };
    });
    this.arrows = arrows.map(([source, target, topics, mismatches, path, x, y]) => {
      const ends = { source: this.boxes[source], target: this.boxes[target] };
      const found = mismatches.map((k) => graph.mismatches[k]);
      return { ...ends, topics, mismatches: found, path, x, y };
    });
    Object.assign(this, { graph, width, height });
    this.#byKey = new Map(this.boxes.map((box) => [box.key, box]));
  }

  /** A box by its key; undefined when it is not in the picture. */
  box(key) {
    return this.#byKey.get(key);
  }

  /** Nodes, then topics, also topics without a box: [kind, name]. */
  get names() {
    const nodes = this.boxes.filter(({ kind }) => kind === "node");
    return [
      ...nodes.map(({ name }) => ["node", name]),
      ...this.graph.topics.map(({ topic }) => ["topic", topic]),
    ];
  }

  /** The publishers or subscriptions of a node or topic. */
  endpoints(kind, name, side) {
    const known = name.startsWith("/") ? name : null; // nodes that are not known have no name
    return this.graph.endpoints.filter((each) => each.kind === side && each[kind] === known);
  }

  /** The mismatches that a node or topic takes part in. */
  mismatches(kind, name) {
    return this.graph.mismatches.filter(({ topic, publishers, subscriptions }) => {
      return kind === "topic" ? topic === name : [...publishers, ...subscriptions].includes(name);
    });
  }
}

/** The key of a node or topic, which may have the same name. */
export function keyOf(kind, name) {
  return `${kind} ${name}`;
}

/** [kind, name] of a key. */
export function partsOf(key) {
  const at = key.indexOf(" ");
  return [key.slice(0, at), key.slice(at + 1)];
}
