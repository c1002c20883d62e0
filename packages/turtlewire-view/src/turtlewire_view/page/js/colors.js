// The picture's colours in the light and in the dark scheme; bytes for vertices.

const LIGHT = {
  dark: false,
  ground: "#f7f9fd",
  grid: "#8e9bbd",
  ink: "#1b2238",
  halo: "#f7f9fd",
  accent: "#4556ff",
  accentInk: "#ffffff",
  bad: "#c2334d",
  x: "#e02f3f",
  y: "#149a4e",
  z: "#2f5bea",
  head: "#ff1a99",
  shaft: "#b5a52a",
  faded: "#b3b3b3",
};
const DARK = {
  dark: true,
  ground: "#0f1424",
  grid: "#5d6a91",
  ink: "#e8ebf7",
  halo: "#0f1424",
  accent: "#8d97ff",
  accentInk: "#0d1120",
  bad: "#ff8095",
  x: "#ff5566",
  y: "#3ddc84",
  z: "#5b8cff",
  head: "#ff1a99",
  shaft: "#cccc4d",
  faded: "#b3b3b3",
};
const DARK_QUERY = matchMedia("(prefers-color-scheme: dark)");

/** The colours now, as CSS texts; `dark` says which scheme. */
export function currentColors() {
  return DARK_QUERY.matches ? DARK : LIGHT;
}

/** Call `changed(colors)` when the user's scheme changes. */
export function onSchemeChange(changed) {
  DARK_QUERY.addEventListener("change", () => changed(currentColors()));
}

/** Red, green and blue of "#rrggbb", 0 to 255. */
export function bytesOf(color) {
  const number = parseInt(color.slice(1), 16);
  return [number >> 16, (number >> 8) & 255, number & 255];
}

/** A colour by name that stays the same everywhere: for trails. */
export function colorOfName(name) {
  let hash = 0;
  for (const letter of name) hash = (31 * hash + letter.codePointAt(0)) >>> 0;
  return ["#f0883e", "#2fa36f", "#8b6be8", "#22a9b8", "#e05780", "#d9a400"][hash % 6];
}
