// What the page consists of, and how its parts are connected.

import { Connection } from "../kit/connection.js";
import { JointRow } from "../kit/joint_row.js";

const MESSAGE_MS = 8000;
const part = Object.fromEntries([...document.querySelectorAll("[id]")].map((el) => [el.id, el]));

let rows = [];
let version = null;
let playing = false;
let degrees = false;
/** The joint that is being changed by hand: states that are on their way must not move it back. */
let held = null;

const connection = new Connection(showState, {
  joints: takeJoints,
  state: takeState,
  error: ({ text }) => say(text),
});

function showState(state) {
  part.connection.dataset.state = state;
  const lost = "connection lost, trying again …";
  part.connection.textContent = state === "live" ? "connected" : lost;
}

function takeJoints({ version: newVersion, node, robot, joints }) {
  version = newVersion;
  part.node.textContent = node;
  part.robot.textContent = robot || "Joints";
  document.title = robot ? `${robot} · Joint State Publisher` : "Joint State Publisher";
  rows = joints.map((joint) => new JointRow(joint, (position) => set(joint.name, position)));
  rows.forEach((row) => row.setUnit(degrees));
  part.joints.replaceChildren(...rows.map((row) => row.element));
  part.empty.hidden = Boolean(robot) || joints.length > 0;
  part.rigid.hidden = !robot || joints.length > 0;
  part.rigid.textContent = `The robot ${robot} has no joints to move.`;
  for (const button of [part.randomize, part.center, part.play]) button.disabled = !joints.length;
  part.help.hidden = !joints.some(({ mimic }) => mimic === null);
  search();
}

function takeState({ version: stateVersion, positions, playing: nowPlaying }) {
  if (stateVersion !== version) return;
  rows.forEach((row, k) => {
    if (row.element !== held) row.show(positions[k] ?? 0);
  });
  playing = nowPlaying;
  part.play.setAttribute("aria-pressed", playing);
  part.play.textContent = playing ? "Pause" : "Play";
}

function set(joint, position) {
  if (playing) send({ type: "play", on: false });
  send({ type: "set", joint, position });
}

function send(command) {
  if (!connection.send(command)) say("Not connected: the command was not sent.");
}

let messageTimer = 0;
function say(text) {
  part.message.textContent = text;
  part.message.hidden = false;
  clearTimeout(messageTimer);
  messageTimer = setTimeout(() => (part.message.hidden = true), MESSAGE_MS);
}

function search() {
  const words = part.search.value.toLowerCase().split(/\s+/).filter(Boolean);
  for (const row of rows) row.element.hidden = !row.matches(words);
  const seen = rows.filter((row) => !row.element.hidden).length;
  part.count.hidden = !words.length || !rows.length;
  part.count.textContent = `${seen} of ${rows.length} joint${rows.length === 1 ? "" : "s"}`;
}

part.search.oninput = search;
part.randomize.onclick = () => send({ type: "randomize" });
part.center.onclick = () => send({ type: "center" });
part.play.onclick = () => send({ type: "play", on: !playing });
part.unit.onclick = () => {
  degrees = !degrees;
  part.unit.setAttribute("aria-pressed", degrees);
  rows.forEach((row) => row.setUnit(degrees));
};

part.joints.addEventListener("pointerdown", ({ target }) => (held = target.closest(".joint")));
for (const type of ["pointerup", "pointercancel", "blur"]) {
  addEventListener(type, () => (held = null));
}
addEventListener("keydown", (event) => {
  if (event.key !== "/" || event.target.matches("input:not([type=range])")) return;
  event.preventDefault();
  part.search.focus();
});
