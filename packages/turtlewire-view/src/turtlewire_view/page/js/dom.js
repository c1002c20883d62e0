// More helpers for the page's elements.

import { make, setText } from "../kit/dom.js";

/** The first sentence as a line, which opens to show the rest of a longer text. */
export function setLine(element, text) {
  const end = text.search(/[.?!]\s+\S/) + 1;
  if (!end) return setText(element, text);
  let details = element.querySelector("details");
  if (!details) {
    details = make("details", {}, make("summary"), make("span"));
    element.replaceChildren(details);
  }
  setText(details.firstChild, text.slice(0, end));
  setText(details.lastChild, text.slice(end).trim());
}

/** Offer `options` as [value, text] and keep the user's choice, or take the first. */
export function offer(select, options, chosen = select.value) {
  const values = options.map(([value]) => value);
  const shape = JSON.stringify(options);
  if (select.dataset.shape !== shape) {
    select.replaceChildren(...options.map(([value, text]) => new Option(text, value)));
    select.dataset.shape = shape;
  }
  select.value = values.includes(chosen) ? chosen : (values[0] ?? "");
}

/**
 * Let Escape, and a press elsewhere, close an open `details`, and do nothing else: the picture
 * takes no such press.
 */
export function closeFirst(menu) {
  const first = { capture: true };
  addEventListener("keydown", (event) => {
    if (event.key !== "Escape" || !menu.open) return;
    event.stopPropagation();
    menu.open = false;
    menu.querySelector("summary").focus();
  }, first);
  addEventListener("pointerdown", (event) => {
    if (!menu.open || menu.contains(event.target)) return;
    menu.open = false;
    if (event.target.matches("canvas")) event.stopPropagation();
  }, first);
}
