// The page of a class: a card for each student, drawn anew with each picture of the server.
// All texts of the network are set as text, never as HTML.

import { Card } from "./card.js";

const $ = (id) => document.getElementById(id);
const cards = new Map();
const RETRY_MS = 1000;
let seats = [];

function connect() {
  const address = new URL("live", location.href);
  address.protocol = address.protocol.replace("http", "ws");
  const socket = new WebSocket(address);
  socket.onmessage = (event) => {
    seats = JSON.parse(event.data).seats;
    draw();
  };
  socket.onclose = () => {
    $("summary").textContent = "The connection is lost; is `turtlewire class` still running?";
    setTimeout(connect, RETRY_MS);
  };
}

function kind(seat) {
  if (!seat.count) return "off";
  if (!seat.problem) return "on";
  return seat.problem.bad ? "bad" : "note";
}

function wanted(seat) {
  const text = $("filter").value.trim().toLowerCase();
  const show = $("show").value;
  const state = kind(seat);
  if (show === "bad" && state !== "bad") return false;
  if (show === "off" && state !== "off") return false;
  if (show === "on" && state === "off") return false;
  return [seat.name, ...seat.nodes].some((name) => name.toLowerCase().includes(text));
}

const BY = {
  roster: () => 0,
  name: (a, b) => a.name.localeCompare(b.name, undefined, { numeric: true }),
  bad: (a, b) => rank(a) - rank(b),
  idle: (a, b) => (b.idle ?? Infinity) - (a.idle ?? Infinity) || 0,
};

function rank(seat) {
  return ["bad", "note", "off", "on"].indexOf(kind(seat));
}

function draw() {
  const shown = seats.filter(wanted).sort(BY[$("sort").value]);
  const running = seats.filter((seat) => seat.count).length;
  const bad = seats.filter((seat) => kind(seat) === "bad").length;
  $("summary").textContent =
    `${seats.length} students · ${running} running · ${bad} with a problem`;
  $("nothing").hidden = shown.length > 0 || seats.length === 0;
  const elements = shown.map((seat) => {
    if (!cards.has(seat.domain)) cards.set(seat.domain, new Card());
    const card = cards.get(seat.domain);
    card.update(seat, kind(seat));
    return card.element;
  });
  const now = $("cards").children;
  const same = now.length === elements.length && elements.every((each, i) => each === now[i]);
  if (!same) $("cards").replaceChildren(...elements);
  document.body.dataset.pictures = Number(document.body.dataset.pictures ?? 0) + 1;
}

for (const id of ["filter", "show", "sort"]) $(id).addEventListener("input", draw);
$("size").addEventListener("input", () => {
  document.body.dataset.size = $("size").value;
  draw();
});
connect();
