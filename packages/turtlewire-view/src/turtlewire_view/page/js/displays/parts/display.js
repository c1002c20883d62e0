// Base of displays whose parts are drawn from their last content and the options alone.

import { clear } from "./common.js";

export class Display {
  view;
  options;
  #parts = new Map(); // name to { group, header, arrays }

  constructor(view, options) {
    this.view = view;
    this.options = options;
  }

  /** Draw a content into its group; what was there is removed before. */
  draw(_group, _header, _arrays) {}

  show(group, header, arrays) {
    this.#parts.set(header.part ?? "", { group, header, arrays });
    this.#redraw(group, header, arrays);
  }

  setOptions(options) {
    this.options = options;
    for (const [part, { group, header, arrays }] of this.#parts) {
      if (group.parent) this.#redraw(group, header, arrays);
      else this.#parts.delete(part);
    }
  }

  removed(part) {
    this.#parts.delete(part);
  }

  #redraw(group, header, arrays) {
    clear(group);
    this.draw(group, header, arrays);
  }
}
