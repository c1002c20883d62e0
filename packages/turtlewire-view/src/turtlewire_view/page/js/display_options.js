// The options of each kind of display: the server checks choices by the same table.

let table = null;

/** The options of a kind: { name, label, type, value, min, max, step, choices }. */
export async function optionsOf(kind) {
  table ??= load();
  table.catch(() => { table = null; }); // it may be there the next time
  const lists = await table;
  const listed = (name) => lists[name].flatMap((each) => {
    return typeof each === "string" ? listed(each) : [each];
  });
  return listed(kind);
}

async function load() {
  const answer = await fetch(new URL("./displays/options.json", import.meta.url));
  if (!answer.ok) throw new Error(`the table of options cannot be loaded (${answer.status})`);
  return answer.json();
}
