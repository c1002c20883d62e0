// How a turtle of a given name looks: always the same, in every browser.

const LOOKS = [
  { shell: "#2fa36f", rim: "#166a47", scute: "#5cc795", skin: "#a5dc8c", shape: "round" },
  { shell: "#f0883e", rim: "#a94f14", scute: "#ffb073", skin: "#f7d08a", shape: "sea" },
  { shell: "#e05780", rim: "#93234a", scute: "#f792ae", skin: "#f6c6cf", shape: "box" },
  { shell: "#8b6be8", rim: "#4f34a3", scute: "#b7a0ff", skin: "#cfc3f7", shape: "round" },
  { shell: "#e9bb2d", rim: "#96700a", scute: "#ffdf77", skin: "#d7e58a", shape: "sea" },
  { shell: "#22a9b8", rim: "#0e6470", scute: "#6fd8e2", skin: "#a8e6cf", shape: "box" },
  { shell: "#b5653a", rim: "#6d3514", scute: "#d99a72", skin: "#d8c19a", shape: "round" },
  { shell: "#64748b", rim: "#323e50", scute: "#9fb0c8", skin: "#b9d3b0", shape: "sea" },
];

/** Colours and shell shape of the turtle called `name`. */
export function lookOf(name) {
  const number = /(\d+)$/.exec(name);
  if (number && Number(number[1]) > 0) return LOOKS[(Number(number[1]) - 1) % LOOKS.length];
  let hash = 0;
  for (const letter of name) hash = (31 * hash + letter.codePointAt(0)) >>> 0;
  return LOOKS[hash % LOOKS.length];
}
