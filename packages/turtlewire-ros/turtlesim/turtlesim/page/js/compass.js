// Turning to a heading with the keys around F: each turns to the direction in which it lies from F,
// as in turtle_teleop_key.

import { isForTurtles } from "./controls.js";

const KEYS = [
  ["e", 2.3562], ["r", 1.5708], ["t", 0.7854],
  ["d", 3.1416], ["f", null], ["g", 0],
  ["c", -2.3562], ["v", -1.5708], ["b", -0.7854],
];

/**
 * Fill `compass` with buttons that call `rotate(theta)` [rad]; the middle one calls `cancel()`.
 * `mayPress(event)` says whether a key presses its button.
 */
export function listenForRotating(compass, { rotate, cancel, mayPress }) {
  const press = (theta) => (theta === null ? cancel() : rotate(theta));
  const buttons = new Map(
    KEYS.map(([key, theta]) => [key, makeButton(key, theta, () => press(theta))]),
  );
  compass.append(...buttons.values());
  addEventListener("keydown", (event) => {
    const button = buttons.get(event.key.toLowerCase());
    if (!button || event.repeat || !isForTurtles(event) || !mayPress(event)) return;
    button.classList.add("pressed");
    button.click();
  });
  const release = () => buttons.forEach((button) => button.classList.remove("pressed"));
  addEventListener("keyup", release);
  addEventListener("blur", release);
}

function makeButton(key, theta, act) {
  const button = document.createElement("button");
  const degrees = Math.round((theta * 180) / Math.PI);
  button.type = "button";
  button.setAttribute("aria-label", theta === null ? "cancel the rotation" : `turn to ${degrees}°`);
  button.setAttribute("aria-keyshortcuts", key);
  button.title = `${button.getAttribute("aria-label")} (key ${key})`;
  const shape = theta === null ? "M7 7l10 10M17 7L7 17" : "M4 12h15M13 6l6 6-6 6";
  const path = `<path d="${shape}" transform="rotate(${-degrees} 12 12)"/>`;
  button.innerHTML = `<svg viewBox="0 0 24 24" aria-hidden="true">${path}</svg><kbd>${key}</kbd>`;
  button.onclick = act;
  return button;
}
