// One-letter shortcuts can be switched off: speech input, or a slip of the hand, types letters.

const NAME = "turtlewire-letter-keys";

/** Wire the switch, and remember the choice. Returns whether a key press may be a shortcut. */
export function switchLetterKeys(box) {
  box.checked = remembered() !== "off";
  box.addEventListener("change", () => remember(box.checked ? "on" : "off"));
  return ({ key }) => box.checked || key.length > 1 || key === " ";
}

function remembered() {
  try {
    return localStorage.getItem(NAME);
  } catch {
    return null; // the user has blocked storage
  }
}

function remember(text) {
  try {
    localStorage.setItem(NAME, text);
  } catch {
    // The user has blocked storage: the choice holds until the page is closed.
  }
}
