// Small helpers for elements of a page.

export const byId = (id) => document.getElementById(id);

/** Set a text only when it is another one: no needless layout. */
export function setText(element, text) {
  if (element.textContent !== text) element.textContent = text;
}
