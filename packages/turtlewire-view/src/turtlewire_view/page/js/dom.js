// More helpers for the page's elements.

import { setText } from "../kit/dom.js";

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

/** An element with attributes and children; `attributes` may hold `className` and handlers. */
export function make(tag, attributes = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name in element) element[name] = value;
    else element.setAttribute(name, value);
  }
  element.append(...children);
  return element;
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

/** A dl's content from [term, text]; null texts are left out. */
export function setFacts(list, facts) {
  const shown = facts.filter(([, text]) => text !== null && text !== undefined);
  const parts = shown.flatMap(([term, text]) => [
    make("dt", { textContent: term }), make("dd", { textContent: text }),
  ]);
  const isSame = list.textContent === shown.flat().join("");
  if (!isSame || !shown.length) list.replaceChildren(...parts);
}
