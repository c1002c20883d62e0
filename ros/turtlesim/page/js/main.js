// Wiring: the stream feeds field and panel, keys and buttons feed the stream.

import { Connection } from "./connection.js";
import { listenForDriving } from "./controls.js";
import { Field } from "./field.js";
import { FIELD_METRES, Playback, decodeFrame, poseOf } from "./frames.js";
import { Panel } from "./panel.js";

const PANEL_MS = 100;
const DESCRIPTION_MS = 2000;
const byId = (id) => document.getElementById(id);

const field = new Field(byId("ground"), byId("turtles"));
const playback = new Playback();
const panel = new Panel(choose);
let scene = { version: -1, turtles: [], missing: [] };
let driven = null;
let chosen = "turtle1";

const connection = new Connection({
  onState: (state) => panel.showConnection(state, state === "live" ? "live" : "connection lost, trying again …"),
  onScene: takeScene,
  onFrame: takeFrame,
  onError: (text) => console.error(`turtlesim refused a command: ${text}`),
});

function takeScene(message) {
  scene = message;
  driven = scene.turtles.includes(chosen) ? chosen : (scene.turtles[0] ?? null);
  field.setBackground(scene.background);
  field.keepOnly(scene.turtles);
  panel.showScene(scene, driven);
  panel.showHint(scene.missing, (name) => connection.send({ type: "spawn", x: 4, y: 2, theta: 0, name }));
}

function takeFrame(buffer) {
  const frame = decodeFrame(buffer);
  field.addStrokes(frame.strokes, frame.restart);
  if (frame.version === scene.version && frame.turtleCount === scene.turtles.length) playback.push(frame);
}

function choose(name) {
  chosen = driven = name;
  panel.showDriven(driven);
}

function display(now) {
  const poses = playback.newest?.version === scene.version ? playback.sample(now) : null;
  if (poses) field.drawTurtles(scene.turtles, poses, driven, now);
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
const somewhere = () => 1 + Math.random() * (FIELD_METRES - 2);
byId("spawn").onclick = () => connection.send({ type: "spawn", x: somewhere(), y: somewhere(), theta: Math.random() * 2 * Math.PI, name: "" });
byId("clear").onclick = () => connection.send({ type: "clear" });
byId("reset").onclick = () => connection.send({ type: "reset" });
