// Small helpers for elements of a page.

export const byId = (id) => document.getElementById(id);

/** Set a text only when it is another one: no needless layout. */
export function setText(element, text) {
  if (element.textContent !== text) element.textContent = text;
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

/** A dl's content from [term, text]; null texts are left out. */
export function setFacts(list, facts) {
  const shown = facts.filter(([, text]) => text !== null && text !== undefined);
  const parts = shown.flatMap(([term, text]) => [
    make("dt", { textContent: term }), make("dd", { textContent: text }),
  ]);
  const isSame = list.textContent === shown.flat().join("");
  if (!isSame || !shown.length) list.replaceChildren(...parts);
}
