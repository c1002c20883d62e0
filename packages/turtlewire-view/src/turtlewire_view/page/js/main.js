// Wiring: packets feed the frames, the picture and the panels; the user's choices go to the server.

import { Connection } from "../kit/connection.js";
import { byId, setText } from "../kit/dom.js";
import { switchLetterKeys } from "../kit/letter_keys.js";
import { byName } from "../kit/names.js";
import { Budget } from "./budget.js";
import { Displays, Robots } from "./displays.js";
import { DisplaysPanel } from "./displays_panel.js";
import { closeFirst, offer } from "./dom.js";
import { Frames, Hiding } from "./frames.js";
import { JointsPanel } from "./joints_panel.js";
import { applySwitches, listenForFiles, listenForLooks, takeSaved } from "./looks.js";
import { RelationPanel } from "./relation_panel.js";
import { Stage } from "./stage.js";
import { TimeBar } from "./time_bar.js";
import { Tools } from "./tools.js";
import { TreeView } from "./tree_view.js";
import { graphicsLoaded, View } from "./scene.js";

const NOTICE_MS = 6000;
/** Where keys are for the control itself: all of them, or the space bar. */
const TYPED_IN = "select, textarea, input:not([type=checkbox])";
const PRESSED = "button, summary, input";

let looks = null;
let chosenFixed = "";
let hasView = false;
let lastLoad = 0; // counts the loaded views
let loadedDocument = null; // names the loaded file to the server
let noticeTimer = null;
let standing = { text: "", level: "ok" }; // the line that does not pass
const frames = new Frames();
const send = (command) => connection.send(command);
const hiding = new Hiding(applyHiding);
await graphicsLoaded();
const stage = makeStage();
if (stage) looks = listenForLooks(stage, () => relation.source);
const relation = new RelationPanel(frames, takeChoice);
const tree = new TreeView(frames, {
  select,
  hide: (name, on) => hiding.set(name, on),
  hover: (k) => stage?.hover(k),
  follow: (name) => stage?.cameras.follow(name),
});
const displays = new Displays(stage?.view ?? null, frames, send, () => displaysPanel.show());
displays.onGrowth = () => stage?.takeDisplay();
const displaysPanel = new DisplaysPanel(displays);
const robots = new Robots(displays);
const joints = new JointsPanel((positions) => send({ type: "move", positions }));
const time = new TimeBar(send);
const tools = stage && new Tools(stage, frames, send, (text, passes = false) => {
  notice(text, "ok", passes);
});
const budget = new Budget(stage?.view.isSoftware ?? true, send);

const connection = new Connection(takeState, {
  hello: takeHello,
  names: takeNames,
  frames: takePoses,
  tree: takeTree,
  joints: (packet) => joints.describe(packet.joints),
  positions: (packet) => joints.show(packet.of),
  relation: (packet) => relation.show(packet),
  topics: takeTopics,
  display: (packet) => displays.take(packet),
  pose: (packet) => displays.take(packet),
  removed: (packet) => displays.take(packet),
  status: takeStatus,
  time: takeTime,
  view: takeView,
  saved: takeSaved,
  published: ({ topic, heard }) => {
    if (heard) notice(`Published on ${topic}`, "ok");
    else notice(`Published on ${topic}, but no node subscribes to it`, "warn");
  },
  error: ({ text }) => notice(text, "error"),
});

/** Everything that is drawn, or null when this browser cannot. */
function makeStage() {
  try {
    const view = new View(byId("scene"));
    return new Stage(view, frames, {
      select: (k, event) => select(frames.names[k] ?? "", event),
      hover: (k) => tree.showHovered(k),
      look: () => looks?.show(),
    });
  } catch (error) {
    notice(`${error.message} The tree and the numbers still work.`, "error", false);
    return null;
  }
}

function takeState(state) {
  const pill = byId("connection");
  pill.dataset.state = state;
  setText(pill, state === "live" ? "live" : "connection lost, trying again …");
  byId("stage").toggleAttribute("data-stale", state === "lost");
  if (state !== "live") return;
  if (chosenFixed) send({ type: "fixed", frame: chosenFixed });
  budget.announce();
  displays.announceAll();
  takeChoice();
}

function takeHello({ source }) {
  time.isBag = source.kind === "bag";
  tools?.refuse(time.isBag ? "You cannot publish into a bag." : "");
  if (time.isBag) setText(byId("no-frames"), "The bag has no transforms.");
  setText(byId("source"), source.name);
  document.title = `${source.name} · turtlewire view`;
}

function takeNames(packet) {
  frames.takeNames(packet);
  chosenFixed = packet.chosen ?? chosenFixed;
  hiding.apply(frames);
  const others = [...frames.names].sort(byName).map((name) => [name, name]);
  const automatic = frames.roots[0] ? `automatic (${frames.roots[0]})` : "automatic";
  offer(byId("fixed"), [["", automatic], ...others], chosenFixed);
  tree.rebuild();
  stage?.takeNames();
  relation.rebuild();
  showSelection();
  if (packet.loops?.length) notice(`Frames in a loop: ${packet.loops[0].join(" → ")}`, "error");
}

function takePoses(packet) {
  if (!frames.takePoses(packet)) return;
  displays.follow(); // before the camera looks where all is
  stage?.takePoses();
}

/** A bag has no ages and delays; while a live view is paused, ages do not grow. */
function takeTree({ rows }) {
  if (time.isBag) tree.showReadings(rows.map((row) => ({ ...row, age: null, delay: null })));
  else if (!time.isPaused || !tree.hasReadings) tree.showReadings(rows);
  relation.showFacts(tree.readingOf(relation.source) ?? {});
}

function takeTopics({ topics }) {
  displaysPanel.showTopics(topics);
  robots.take(topics);
}

function takeTime(packet) {
  time.show(packet);
  frames.ages.setPaused(time.isPaused);
}

function takeStatus(packet) {
  if (packet.id !== null && packet.id !== undefined) displays.take(packet);
  else notice(packet.text, packet.level, false);
}

async function takeView(packet) {
  if (packet.first && hasView) return; // a new connection; the user may have changed much
  hasView = true;
  const load = (lastLoad += 1);
  robots.isOn = false; // the file says what is shown
  loadedDocument = packet.document ?? null;
  notice("", "ok"); // ends what was said of the file before
  showUnread(packet.text);
  applySwitches(packet.show);
  if (packet.fixed) chooseFixed(packet.fixed);
  if (packet.camera) stage?.cameras.restore(packet.camera, frames.origin);
  for (const { id } of displays.list) displays.remove(id);
  for (const display of packet.displays ?? []) {
    await displays.add(display);
    if (load !== lastLoad) return; // another view came meanwhile
  }
}

function select(name, event) {
  if (name && event?.shiftKey && relation.source) relation.chooseTarget(name);
  else relation.choose(name);
}

/** The user chose frames (or the connection is new): ask, and show them. */
function takeChoice() {
  const { source, target } = relation;
  const isWhole = source && target;
  send({ type: "relation", ...(isWhole ? { target, source } : { target: null }) });
  relation.showFacts(tree.readingOf(source) ?? {});
  showSelection();
}

function showSelection() {
  const { source, target } = relation;
  const k = frames.index(source);
  const path = stage?.select(k, frames.index(target)) ?? [];
  tree.showSelection(source, path);
  byId("frame-actions").hidden = k < 0;
  byId("hide-one").setAttribute("aria-pressed", String(k >= 0 && frames.hidden[k] === 1));
  byId("trail").setAttribute("aria-pressed", String(stage?.trails.has(source) ?? false));
  looks?.show();
}

function applyHiding() {
  hiding.apply(frames);
  tree.rebuild();
  showSelection();
  stage?.change();
}

/** Show a notice; when one that passes has ended, the last one that stays is shown again. */
function notice(text, level, passes = true) {
  if (!passes) standing = { text, level };
  const said = passes && text ? { text, level } : standing;
  const line = byId("notice");
  line.hidden = !said.text;
  line.dataset.level = said.level;
  setText(line, said.text);
  clearTimeout(noticeTimer);
  if (said !== standing) noticeTimer = setTimeout(() => notice("", "ok"), NOTICE_MS);
}

/** The list of unsupported settings stays until the user dismisses it or loads another file. */
function showUnread(text) {
  byId("unread").hidden = !text;
  setText(byId("unread").querySelector("span"), text);
}

function chooseFixed(name) {
  chosenFixed = name;
  byId("fixed").value = name;
  send({ type: "fixed", frame: name });
}

closeFirst(byId("looks"));
byId("unread").querySelector("button").onclick = () => showUnread("");
const mayAct = switchLetterKeys(byId("letter-keys"));
byId("fixed").onchange = ({ target }) => chooseFixed(target.value);
byId("use-fixed").onclick = () => chooseFixed(relation.source);
byId("hide-one").onclick = () => {
  hiding.set(relation.source, frames.hidden[frames.index(relation.source)] === 0);
};
byId("trail").onclick = () => {
  stage?.trails.toggle(relation.source);
  stage?.change();
  showSelection();
};
addEventListener("keydown", (event) => {
  if (event.key === "Escape" && tools?.active) return tools.choose("");
  if (event.target.matches(TYPED_IN)) return;
  if (event.key === " " && event.target.matches(PRESSED)) return;
  if (event.ctrlKey || event.altKey || event.metaKey || !mayAct(event)) return;
  const acts = {
    " ": () => time.toggle(),
    n: () => time.now(),
    Escape: () => select(""),
    "/": () => byId("search").focus(),
  };
  const act = acts[event.key] ?? looks?.keys[event.key] ?? tools?.keys[event.key];
  if (!act) return;
  event.preventDefault();
  act();
});
listenForFiles(() => ({
  fixed: chosenFixed || frames.fixed,
  displays: displays.list,
  document: loadedDocument,
  camera: stage?.cameras.isTouched ? stage.cameras.saved(frames.origin) : null,
}), send, (text) => notice(text, "error"));
if (stage) {
  const loss = "The browser closed the 3D view (WebGL context lost). "
    + "The tree and the numbers keep updating.";
  stage.view.lost.push((isLost) => notice(isLost ? loss : "", "error", false));
  stage.view.afterDraw((now) => {
    if (!displays.list.some(({ visible }) => visible)) return;
    requestAnimationFrame((next) => budget.take(next - now));
  });
}

/** For tests and for curious people: `(await import("./js/main.js")).stage`. */
export { displays, frames, robots, stage };
