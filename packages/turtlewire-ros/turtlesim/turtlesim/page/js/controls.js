// Keys and buttons. Each press is one command, as in turtle_teleop_key; holding repeats it.

const LINEAR = 2.0;
const ANGULAR = 2.0;
const REPEAT_MS = 120;
const DRIVES = {
  up: { linear: LINEAR, angular: 0 },
  down: { linear: -LINEAR, angular: 0 },
  left: { linear: 0, angular: ANGULAR },
  right: { linear: 0, angular: -ANGULAR },
};
const KEYS = { ArrowUp: "up", ArrowDown: "down", ArrowLeft: "left", ArrowRight: "right" };

const TAKES_KEYS = "select, input:not([type=checkbox])";

/** Whether a key press is for the turtles, not for the browser or for a list that scrolls. */
export function isForTurtles(event) {
  const { target } = event;
  if (event.ctrlKey || event.altKey || event.metaKey || target.matches?.(TAKES_KEYS)) return false;
  const isOfDriven = target.matches?.("[aria-pressed=true]"); // who chose a turtle drives it
  return isOfDriven || !target.closest?.(".scroll");
}

/** Call `drive({linear, angular})` for each press of an arrow key or of the pad. */
export function listenForDriving(pad, drive) {
  const all = [...pad.querySelectorAll("button")];
  const buttons = new Map(all.map((button) => [button.dataset.drive, button]));
  addEventListener("keydown", (event) => {
    const direction = KEYS[event.key];
    if (!direction || !isForTurtles(event)) return;
    event.preventDefault();
    buttons.get(direction).classList.add("pressed");
    drive(DRIVES[direction]);
  });
  addEventListener("keyup", (event) => buttons.get(KEYS[event.key])?.classList.remove("pressed"));
  addEventListener("blur", () => buttons.forEach((button) => button.classList.remove("pressed")));
  for (const [direction, button] of buttons) {
    repeatWhilePressed(button, () => drive(DRIVES[direction]));
  }
}

function repeatWhilePressed(button, act) {
  let timer = null;
  const release = () => clearInterval(timer);
  button.addEventListener("pointerdown", (event) => {
    if (event.button !== 0) return;
    act();
    clearInterval(timer);
    timer = setInterval(act, REPEAT_MS);
  });
  for (const type of ["pointerup", "pointercancel", "pointerleave"]) {
    button.addEventListener(type, release);
  }
  button.addEventListener("click", (event) => {
    if (event.detail === 0) act(); // the keyboard or a screen reader pressed it
  });
  button.addEventListener("contextmenu", (event) => event.preventDefault());
}
