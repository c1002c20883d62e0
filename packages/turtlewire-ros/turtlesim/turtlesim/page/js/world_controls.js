// The driven turtle's pen, the background, the pace: set here, and shown as they are.

import { byId } from "../kit/dom.js";


/**
 * Send what the user changes; `driven()` is the name of the driven turtle or null. Returns
 * `show(scene, driven)`, which shows what the simulator says.
 */
export function controlWorld(send, driven) {
  const [colour, width, up] = ["pen-colour", "pen-width", "pen-up"].map(byId);
  const [background, pause, speed] = ["background", "pause", "speed"].map(byId);
  let before = 1; // the speed to go on with after a pause
  let told = () => {}; // shows again what the simulator said last

  const setPen = (off) => {
    if (driven() === null) return;
    const rgb = channels(colour.value);
    send({ type: "pen", turtle: driven(), ...rgb, width: Number(width.value), off });
  };
  colour.onchange = () => setPen(false); // choosing a colour puts the pen down
  width.onchange = () => setPen(false);
  up.onclick = () => setPen(up.getAttribute("aria-pressed") !== "true");
  background.onchange = () => send({ type: "background", ...channels(background.value) });
  const isPaused = () => pause.getAttribute("aria-pressed") === "true";
  pause.onclick = () => send({ type: "speed", factor: isPaused() ? before : 0 });
  speed.onchange = () => send({ type: "speed", factor: Number(speed.value) });

  width.onblur = () => told();

  const show = (scene, name) => {
    const pen = scene.pens[scene.turtles.indexOf(name)];
    for (const control of [colour, width, up]) control.disabled = !pen;
    if (pen) showPen(pen, { colour, width, up });
    background.value = hex(scene.background);
    if (scene.speed) before = scene.speed;
    offer(speed, before);
    pause.setAttribute("aria-pressed", String(scene.speed === 0));
    byId("pause-word").textContent = scene.speed === 0 ? "Go on" : "Pause";
  };
  return (scene, name) => {
    told = () => show(scene, name);
    told();
  };
}

function showPen([css, pixels, draws], { colour, width, up }) {
  colour.value = css;
  if (document.activeElement !== width) width.value = pixels; // else it moves below the finger
  up.setAttribute("aria-pressed", String(!draws));
}

/** Choose a speed in the list, which gets it if it is not there. */
function offer(list, factor) {
  const known = [...list.options].some((option) => Number(option.value) === factor);
  if (!known) list.add(new Option(`${factor} ×`, factor));
  list.value = factor;
}

function channels(css) {
  const [r, g, b] = [1, 3, 5].map((at) => parseInt(css.slice(at, at + 2), 16));
  return { r, g, b };
}

function hex(rgb) {
  return `#${rgb.map((value) => value.toString(16).padStart(2, "0")).join("")}`;
}
