// Names as people sort and seek them.

const collator = new Intl.Collator("en", { numeric: true });

/** Compare names so that turtle2 stands before turtle10. */
export function byName(a, b) {
  return collator.compare(a, b);
}

/** Whether a name has all words of a search in it, in whatever case and order. */
export function isFound(name, search) {
  const text = name.toLowerCase();
  return search.toLowerCase().split(/\s+/).every((word) => text.includes(word));
}
