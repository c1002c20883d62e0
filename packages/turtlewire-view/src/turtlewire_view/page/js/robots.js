// Robots are shown without a request, as soon as a node publishes a description.

export class Robots {
  /** Whether to add displays; not when a loaded view names those that are wanted. */
  isOn = true;
  #displays;
  #known = new Set(); // topics; a display that the user removed does not come back

  constructor(displays) {
    this.#displays = displays;
  }

  /** Take the server's topics, and show each robot that is new. */
  take(topics) {
    if (!this.isOn) return;
    const described = topics.filter(({ kind, publishers }) => kind === "robot_model" && publishers);
    for (const { name, kind } of described.filter(({ name }) => !this.#known.has(name))) {
      this.#known.add(name);
      const isShown = this.#displays.list.some((each) => each.kind === kind && each.topic === name);
      if (!isShown) this.#displays.add({ kind, topic: name });
    }
  }
}
