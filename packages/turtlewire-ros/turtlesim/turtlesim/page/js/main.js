// Wiring: the stream feeds field and panels; keys, buttons and the pointer feed the stream.

import { Connection } from "../kit/connection.js";
import { byId } from "../kit/dom.js";
import { download } from "../kit/download.js";
import { switchLetterKeys } from "../kit/letter_keys.js";
import { listenForRotating } from "./compass.js";
import { listenForDriving } from "./controls.js";
import { Field } from "./field.js";
import { FIELD_METRES, Playback, frameOf, poseOf } from "./frames.js";
import { FramesPanel } from "./frames_panel.js";
import { Panel } from "./panel.js";
import { Pointer } from "./pointer.js";
import { paceInWords } from "./words.js";
import { controlWorld } from "./world_controls.js";

const PANEL_MS = 100;
const DESCRIPTION_MS = 2000;

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

const connection = new Connection(takeState, {
  scene: takeScene,
  tf: (message) => framesPanel.show(message),
  axes: ({ frames }) => (axes = frames),
  frame: takeFrame,
  error: ({ text }) => console.error(`turtlesim rejected a command: ${text}`),
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

function takeFrame(packet) {
  const frame = frameOf(packet);
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

byId("picture").onclick = async () => download(await field.picture(), "turtlesim", "png");
