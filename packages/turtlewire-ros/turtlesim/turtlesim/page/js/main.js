// Wiring: the stream feeds field and panels; keys, buttons and the pointer feed the stream.

import { listenForRotating } from "./compass.js";
import { Connection } from "./connection.js";
import { listenForDriving } from "./controls.js";
import { Field } from "./field.js";
import { FIELD_METRES, Playback, decodeFrame, poseOf } from "./frames.js";
import { FramesPanel } from "./frames_panel.js";
import { switchLetterKeys } from "./letter_keys.js";
import { Panel } from "./panel.js";
import { Pointer } from "./pointer.js";
import { paceInWords } from "./words.js";
import { controlWorld } from "./world_controls.js";

const PANEL_MS = 100;
const DESCRIPTION_MS = 2000;
const byId = (id) => document.getElementById(id);

const field = new Field(byId("ground"), byId("turtles"));
const playback = new Playback();
const panel = new Panel(choose);
const framesPanel = new FramesPanel((watch) => {
  connection.send(watch ? { type: "watch", ...watch } : { type: "unwatch" });
});
const pointer = new Pointer(field, {
  turtles: () => (newestPoses() ?? []).map((pose, k) => ({ name: scene.turtles[k], ...pose })),
  choose,
  move: (turtle, { x, y, theta }) => connection.send({ type: "teleport", turtle, x, y, theta }),
  spawn,
  placingChanged: showPlacing,
});
let scene = { version: -1, turtles: [], missing: [], pens: [], speed: 1 };
let driven = null;
let chosen = "turtle1";
let axes = null; // as they came last

const connection = new Connection({
  onState: takeState,
  onScene: takeScene,
  onTransforms: (message) => framesPanel.show(message),
  onAxes: (frames) => (axes = frames),
  onFrame: takeFrame,
  onError: (text) => console.error(`turtlesim rejected a command: ${text}`),
});

const showSettings = controlWorld((command) => connection.send(command), () => driven);

function takeState(state) {
  const lost = "connection lost, trying again …";
  panel.showConnection(state, state === "live" ? paceInWords(scene.speed) : lost);
  if (state === "live") framesPanel.watch();
}

function takeScene(message) {
  scene = message;
  driven = scene.turtles.includes(chosen) ? chosen : (scene.turtles[0] ?? null);
  field.setBackground(scene.background);
  field.keepOnly(scene.turtles);
  panel.showScene(scene, driven);
  panel.showConnection("live", paceInWords(scene.speed));
  byId("connection").toggleAttribute("data-paused", scene.speed === 0);
  playback.speed = scene.speed;
  showSettings(scene, driven);
  panel.showHint(scene.missing, (name) => spawn({ x: 4, y: 2, theta: 0, name }));
}

function takeFrame(buffer) {
  const frame = decodeFrame(buffer);
  field.addStrokes(frame.strokes, frame.restart);
  const isCurrent = frame.version === scene.version;
  frame.axes = framesPanel.drawn ? axes : null;
  if (isCurrent && frame.turtleCount === scene.turtles.length) playback.push(frame);
}

function choose(name) {
  chosen = driven = name;
  panel.showDriven(driven);
  showSettings(scene, driven);
}

function spawn({ x, y, theta, name = "" }) {
  connection.send({ type: "spawn", x, y, theta, name });
}

function display(now) {
  const seen = playback.newest?.version === scene.version ? playback.sample(now) : null;
  if (seen) {
    const drawn = seen.axes && { frames: seen.axes, ...framesPanel.arrow };
    const { ghost } = pointer;
    field.drawTurtles(scene.turtles, seen.poses, { driven, ghost, axes: drawn, now });
  }
  requestAnimationFrame(display);
}

/** The newest poses, not smoothed, or null when none belong to the present scene. */
function newestPoses() {
  const frame = playback.newest;
  return frame?.version === scene.version ? scene.turtles.map((_, k) => poseOf(frame, k)) : null;
}

function every(milliseconds, show) {
  setInterval(() => {
    const poses = newestPoses();
    if (poses) show(poses);
  }, milliseconds);
}

every(PANEL_MS, (poses) => panel.showPoses(poses, driven));
every(DESCRIPTION_MS, (poses) => panel.describeField(poses));
requestAnimationFrame(display);

listenForDriving(byId("pad"), ({ linear, angular }) => {
  if (driven !== null) connection.send({ type: "drive", turtle: driven, linear, angular });
});

listenForRotating(byId("compass"), {
  mayPress: switchLetterKeys(byId("letter-keys")),
  rotate: (theta) => driven !== null && connection.send({ type: "rotate", turtle: driven, theta }),
  cancel: () => driven !== null && connection.send({ type: "cancel", turtle: driven }),
});

/** By pointer, the next press on the field places the turtle; by keyboard its place is random. */
byId("spawn").onclick = ({ detail }) => {
  const somewhere = () => 1 + Math.random() * (FIELD_METRES - 2);
  const theta = (2 * Math.random() - 1) * Math.PI;
  if (detail === 0) spawn({ x: somewhere(), y: somewhere(), theta });
  else pointer.setPlacing(!pointer.placing);
};

function showPlacing(on) {
  byId("spawn").setAttribute("aria-pressed", String(on));
  byId("placing").hidden = !on;
}

byId("clear").onclick = () => connection.send({ type: "clear" });
byId("reset").onclick = () => connection.send({ type: "reset" });

byId("follow").onclick = ({ currentTarget }) => {
  field.setFollow(!field.follows);
  currentTarget.setAttribute("aria-pressed", String(field.follows));
};

byId("axes").onclick = ({ currentTarget }) => {
  framesPanel.draw(!framesPanel.drawn);
  currentTarget.setAttribute("aria-pressed", String(framesPanel.drawn));
};

byId("picture").onclick = async () => {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(await field.picture());
  link.download = `turtlesim-${new Date().toISOString().slice(0, 19).replaceAll(":", "-")}.png`;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
};
