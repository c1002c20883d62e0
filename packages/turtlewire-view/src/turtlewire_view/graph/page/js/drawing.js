// The picture: boxes and arrows as elements of SVG, at the places that the server computed.

const SVG = "http://www.w3.org/2000/svg";
const FAR_SCALE = 0.3; // names cannot be read below it
const TEXT_DROP = 4.7; // from the middle of a text to its baseline

export class Drawing {
  #svg;
  #model;
  #boxes = new Map(); // key to element
  #arrows = []; // [arrow, element]
  #rates = new Map(); // key to text
  #selected = "";

  /** `select(key)` is called for a press on a box or arrow, and with "" for one beside them. */
  constructor(svg, model, camera, select) {
    this.#svg = svg;
    this.#model = model;
    svg.addEventListener("click", ({ target }) => {
      if (!camera().hasDragged) select(target.closest("[data-key]")?.dataset.key ?? "");
    });
  }

  /** Draw what the model has now. */
  draw() {
    const { boxes, arrows } = this.#model;
    this.#boxes.clear();
    this.#rates.clear();
    const sorted = [...arrows].sort((a, b) => a.mismatches.length - b.mismatches.length);
    this.#arrows = sorted.map((arrow) => [arrow, drawnArrow(arrow)]);
    for (const box of boxes) this.#boxes.set(box.key, drawnBox(box));
    const words = sorted.filter(({ mismatches, target }) => {
      return mismatches.length && target.kind === "node";
    }).map(drawnWord);
    this.#svg.replaceChildren(
      ...this.#arrows.map(([, element]) => element), ...this.#boxes.values(), ...words,
    );
    this.select(this.#selected);
  }

  /** Show what a box is connected to; "" shows all alike. */
  select(key) {
    this.#selected = key;
    const isThere = this.#boxes.has(key);
    this.#svg.toggleAttribute("data-selection", isThere);
    const near = new Set(isThere ? [key] : []);
    for (const [{ source, target }, element] of this.#arrows) {
      const isNear = isThere && (source.key === key || target.key === key);
      element.toggleAttribute("data-near", isNear);
      if (isNear) near.add(source.key).add(target.key);
    }
    for (const [each, element] of this.#boxes) {
      element.toggleAttribute("data-near", near.has(each));
      element.toggleAttribute("data-selected", each === key);
    }
  }

  /** Write rates above the boxes of topics: name to text. */
  showRates(rates) {
    for (const [key, element] of this.#rates) {
      if (key in rates) continue;
      element.remove();
      this.#rates.delete(key);
    }
    for (const [key, text] of Object.entries(rates)) {
      const box = this.#model.box(key);
      if (!box) continue;
      if (!this.#rates.has(key)) {
        const at = { x: box.x + box.width, y: box.y - 4, class: "rate", "text-anchor": "end" };
        this.#rates.set(key, make("text", at));
        this.#boxes.get(key).append(this.#rates.get(key));
      }
      this.#rates.get(key).textContent = text;
    }
  }

  /** Names that cannot be read are not drawn, which costs much in a large graph. */
  showScale(scale) {
    this.#svg.toggleAttribute("data-far", scale < FAR_SCALE);
  }
}

function drawnArrow({ source, target, topics, mismatches, path }) {
  const topic = source.kind === "topic" ? source : target.kind === "topic" ? target : null;
  const key = topic?.key ?? `topic ${topics[0]}`;
  const arrow = make("g", { class: "arrow", "data-key": key });
  arrow.toggleAttribute("data-bad", mismatches.length > 0);
  const reasons = mismatches.map(({ reason }) => reason);
  arrow.append(
    titled(`${source.name} → ${target.name}\n${[topics.join(", "), ...reasons].join("\n")}`),
    make("path", { class: "reach", d: path }), make("path", { d: path }),
  );
  return arrow;
}

function drawnBox({ key, kind, name, note, x, y, width, height, label }) {
  const box = make("g", { class: `box ${kind}`, "data-key": key });
  box.toggleAttribute("data-odd", Boolean(note));
  const middle = { x: x + width / 2, y: y + height / 2 + TEXT_DROP, "text-anchor": "middle" };
  const text = make("text", middle);
  text.textContent = label;
  const round = kind === "node" ? height / 2 : 4;
  box.append(titled(note ? `${name}\n${note}` : name),
    make("rect", { x, y, width, height, rx: round }), text);
  return box;
}

function drawnWord({ mismatches, x, y }) {
  const word = make("text", { class: "policy", x, y: y - 5, "text-anchor": "middle" });
  word.textContent = [...new Set(mismatches.map(({ policy }) => policy))].join(", ");
  return word;
}

function titled(text) {
  const title = make("title");
  title.textContent = text;
  return title;
}

function make(tag, attributes = {}) {
  const element = document.createElementNS(SVG, tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  return element;
}
