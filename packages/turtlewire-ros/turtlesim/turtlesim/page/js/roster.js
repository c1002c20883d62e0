// The list of the turtles with their numbers.

import { byId } from "../kit/dom.js";
import { lookOf } from "./looks.js";
import { byName, isFound } from "../kit/names.js";

const MOST_ROWS = 60; // more are found by a search
const FEW = 8; // a number that users see at a glance

export class Roster {
  #rows = new Map();
  #order = new Map(); // name to its place in the scene
  #names = [];
  #driven = null;
  #onChoose;

  /** `onChoose(name)`: the user wants to drive another turtle. */
  constructor(onChoose) {
    this.#onChoose = onChoose;
    byId("find-turtle").addEventListener("input", () => this.#list());
  }

  /** `names` in the scene's order. */
  show(names) {
    this.#order = new Map(names.map((name, k) => [name, k]));
    this.#names = [...names].sort(byName);
    byId("find-turtle").hidden = names.length <= FEW;
    if (names.length <= FEW) byId("find-turtle").value = "";
    this.#list();
  }

  showDriven(driven) {
    this.#driven = driven;
    for (const [name, { button }] of this.#rows) {
      button.setAttribute("aria-pressed", String(name === driven));
    }
  }

  /** `poses` in the scene's order. */
  showPoses(poses) {
    for (const [name, { cells }] of this.#rows) {
      const { x, y, theta, v, w } = poses[this.#order.get(name)];
      const degrees = `${Math.round((theta * 180) / Math.PI)}°`;
      const texts = [x.toFixed(2), y.toFixed(2), degrees, v.toFixed(2), w.toFixed(2)];
      cells.forEach((cell, column) => {
        if (cell.textContent !== texts[column]) cell.textContent = texts[column];
      });
    }
  }

  #list() {
    const found = this.#names.filter((name) => isFound(name, byId("find-turtle").value));
    const names = found.slice(0, MOST_ROWS);
    if (names.join("\n") !== [...this.#rows.keys()].join("\n")) {
      this.#rows = new Map(names.map((name) => [name, this.#row(name)]));
      byId("roster").replaceChildren(...[...this.#rows.values()].map(({ row }) => row));
    }
    const hidden = found.length - names.length;
    byId("more").hidden = hidden <= 0 && found.length > 0;
    byId("more").textContent = found.length ? `and ${hidden} more` : "no turtle with this name";
    this.showDriven(this.#driven);
  }

  #row(name) {
    const row = document.createElement("tr");
    const look = lookOf(name);
    const button = document.createElement("button");
    button.type = "button";
    button.title = `Drive ${name}`;
    button.style.setProperty("--shell", look.shell);
    button.style.setProperty("--rim", look.rim);
    const label = document.createElement("span");
    label.textContent = name;
    button.append(document.createElement("i"), label);
    button.onclick = () => this.#onChoose(name);
    const head = document.createElement("th");
    head.scope = "row";
    head.append(button);
    row.append(head);
    return { row, button, cells: Array.from({ length: 5 }, () => row.insertCell()) };
  }
}
