// The page of a class: a card for each student, redrawn with each picture of the server.
// All texts of the network are set as text, never as HTML.

import { Connection } from "../kit/connection.js";
import { byId } from "../kit/dom.js";
import { byName } from "../kit/names.js";
import { Card } from "./card.js";

const cards = new Map();
let seats = [];

new Connection(showState, { seats: takeSeats });

function showState(state) {
  if (state === "live") return;
  byId("summary").textContent = "The connection is lost; is `turtlewire class` still running?";
}

function takeSeats(message) {
  ({ seats } = message);
  draw();
}

function kind(seat) {
  if (!seat.count) return "off";
  if (!seat.problem) return "on";
  return seat.problem.bad ? "bad" : "note";
}

function wanted(seat) {
  const text = byId("filter").value.trim().toLowerCase();
  const show = byId("show").value;
  const state = kind(seat);
  if (show === "bad" && state !== "bad") return false;
  if (show === "off" && state !== "off") return false;
  if (show === "on" && state === "off") return false;
  return [seat.name, ...seat.nodes].some((name) => name.toLowerCase().includes(text));
}

const BY = {
  roster: () => 0,
  name: (a, b) => byName(a.name, b.name),
  bad: (a, b) => rank(a) - rank(b),
  idle: (a, b) => (b.idle ?? Infinity) - (a.idle ?? Infinity) || 0,
};

function rank(seat) {
  return ["bad", "note", "off", "on"].indexOf(kind(seat));
}

function draw() {
  const shown = seats.filter(wanted).sort(BY[byId("sort").value]);
  const running = seats.filter((seat) => seat.count).length;
  const bad = seats.filter((seat) => kind(seat) === "bad").length;
  const students = `${seats.length} student${seats.length === 1 ? "" : "s"}`;
  byId("summary").textContent = `${students} · ${running} running · ${bad} with a problem`;
  byId("nothing").hidden = shown.length > 0 || seats.length === 0;
  const elements = shown.map((seat) => {
    if (!cards.has(seat.domain)) cards.set(seat.domain, new Card());
    const card = cards.get(seat.domain);
    card.update(seat, kind(seat));
    return card.element;
  });
  const now = byId("cards").children;
  const same = now.length === elements.length && elements.every((each, i) => each === now[i]);
  if (!same) byId("cards").replaceChildren(...elements);
  document.body.dataset.pictures = Number(document.body.dataset.pictures ?? 0) + 1;
}

for (const id of ["filter", "show", "sort"]) byId(id).addEventListener("input", draw);
byId("size").addEventListener("input", () => {
  document.body.dataset.size = byId("size").value;
  draw();
});
