// Wiring: the server's graph feeds the picture and the lists; the user's choices go to the server.

import { Connection } from "../kit/connection.js";
import { byId, make, setText } from "../kit/dom.js";
import { switchLetterKeys } from "../kit/letter_keys.js";
import { Camera } from "./camera.js";
import { count, Details, mismatchInWords, rateInWords } from "./details.js";
import { Drawing } from "./drawing.js";
import { GraphModel, keyOf, partsOf } from "./graph_model.js";
import { NamesList } from "./names_list.js";

const NOTICE_MS = 6000;
const FILTER_MS = 250;
const TYPED_IN = "select, textarea, input:not([type=checkbox])";

let selected = "";
let hasChosen = false; // the user, what is shown
let filterTimer = null;
let noticeTimer = null;
let readings = {};
const pinned = new Set();
const model = new GraphModel();
const drawing = new Drawing(byId("picture"), model, () => camera, select);
const camera = new Camera(byId("picture"), (scale) => drawing.showScale(scale));
const names = new NamesList(model, choose);
const details = new Details(model, { choose, pin, isPinned: (topic) => pinned.has(topic) });
const send = (command) => connection.send(command);

const connection = new Connection(takeState, {
  hello: takeHello,
  graph: takeGraph,
  readings: takeReadings,
  error: ({ text }) => notice(text),
});

function takeState(state) {
  const pill = byId("connection");
  pill.dataset.state = state;
  setText(pill, state === "live" ? "live" : "connection lost, trying again …");
  byId("stage").toggleAttribute("data-stale", state === "lost");
}

/** The first words of a new connection: it knows nothing of what the page showed before. */
function takeHello({ source, selection }) {
  setText(byId("source"), source);
  document.title = `${source} · turtlewire graph`;
  if (hasChosen) sendSelection();
  else {
    byId("words").value = selection.words;
    byId("topics").value = selection.topics;
    byId("debug").checked = selection.debug;
  }
  measure();
}

function takeGraph(message) {
  model.take(message);
  drawing.draw();
  camera.take(model);
  names.show();
  details.show(selected);
  showRates();
  showProblems();
  const { nodes, topics } = model.graph;
  const hidden = message.hidden ? `, ${count(message.hidden, "node")} hidden` : "";
  const text = `${count(nodes.length, "node")}, ${count(topics.length, "topic")}`;
  setText(byId("counts"), text + hidden);
  const bad = model.graph.mismatches.length;
  const label = `The graph: ${text}, ${bad ? count(bad, "mismatch") : "no mismatches"}`;
  byId("picture").setAttribute("aria-label", label);
}

function takeReadings({ topics }) {
  readings = topics;
  showRates();
}

function showRates() {
  const rates = Object.entries(readings).filter(([, { rate }]) => rate !== null);
  drawing.showRates(Object.fromEntries(rates.map(([topic, { rate }]) => {
    return [keyOf("topic", topic), rateInWords(rate)];
  })));
  const [kind, name] = partsOf(selected);
  if (kind === "topic" && readings[name]) details.showReading(readings[name]);
}

function showProblems() {
  const { mismatches } = model.graph;
  byId("problems").hidden = !mismatches.length;
  setText(byId("problem-count"), String(mismatches.length));
  byId("problem-list").replaceChildren(...mismatches.map((each) => {
    const text = mismatchInWords(each);
    const button = make("button", { type: "button", className: "link", textContent: text });
    button.onclick = () => choose(keyOf("topic", each.topic));
    return make("li", {}, button);
  }));
}

/** Select a node or topic; its rate is measured as long as it is selected. */
function select(key) {
  selected = key;
  drawing.select(key);
  names.select(key);
  details.show(key);
  measure();
}

/** Select it by its name: it may lie outside the part of the picture that is seen. */
function choose(key) {
  select(key);
  const box = model.box(key);
  if (box) camera.reveal(box);
}

function pin(topic) {
  if (!pinned.delete(topic)) pinned.add(topic);
  details.show(selected);
  measure();
}

function measure() {
  const [kind, name] = partsOf(selected);
  send({ type: "measure", topics: [...new Set([...pinned, ...(kind === "topic" ? [name] : [])])] });
}

function sendSelection() {
  hasChosen = true;
  send({
    type: "show",
    topics: byId("topics").value,
    debug: byId("debug").checked,
    words: byId("words").value,
  });
}

function notice(text) {
  byId("notice").hidden = !text;
  setText(byId("notice"), text);
  clearTimeout(noticeTimer);
  if (text) noticeTimer = setTimeout(() => notice(""), NOTICE_MS);
}

const mayAct = switchLetterKeys(byId("letter-keys"));
byId("topics").onchange = sendSelection;
byId("debug").onchange = sendSelection;
byId("words").oninput = () => {
  clearTimeout(filterTimer);
  filterTimer = setTimeout(sendSelection, FILTER_MS);
};
byId("fit").onclick = () => camera.fit();
addEventListener("keydown", (event) => {
  if (event.target.matches(TYPED_IN) && event.key !== "Escape") return;
  if (event.ctrlKey || event.altKey || event.metaKey || !mayAct(event)) return;
  const acts = {
    Escape: () => select(""),
    Home: () => camera.fit(),
    "/": () => byId("search").focus(),
  };
  if (!acts[event.key]) return;
  event.preventDefault();
  acts[event.key]();
});

/** For tests and for curious people: `(await import("./js/main.js")).model`. */
export { model };
