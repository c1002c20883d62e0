// The texts around the field: who is where, who is driven, what is missing.

import { lookOf } from "./looks.js";
import { fieldInWords, placeInWords, seenFrom } from "./words.js";

const MOST_ROWS = 12;
const MOST_SENTENCES = 3;
const byId = (id) => document.getElementById(id);

export class Panel {
  #rows = new Map();
  #names = [];
  #onChoose;

  /** `onChoose(name)`: the user wants to drive another turtle. */
  constructor(onChoose) {
    this.#onChoose = onChoose;
  }

  showScene(scene, driven) {
    byId("node").textContent = scene.node;
    document.title = `turtlesim ${scene.node}`;
    this.#announceChanges(scene.turtles);
    this.#names = scene.turtles;
    this.#rows.clear();
    const rows = scene.turtles.slice(0, MOST_ROWS).map((name) => this.#row(name));
    byId("roster").replaceChildren(...rows);
    const hidden = scene.turtles.length - MOST_ROWS;
    byId("more").hidden = hidden <= 0;
    byId("more").textContent = `and ${hidden} more`;
    this.showDriven(driven);
  }

  showDriven(driven) {
    byId("driven").textContent = driven ?? "(no turtle)";
    for (const [name, { button }] of this.#rows) {
      button.setAttribute("aria-pressed", String(name === driven));
    }
  }

  /** Numbers and sentences; `poses` in the scene's order. */
  showPoses(poses, driven) {
    this.#names.slice(0, MOST_ROWS).forEach((name, k) => {
      const { x, y, theta, v, w } = poses[k];
      const degrees = `${Math.round((theta * 180) / Math.PI)}°`;
      const texts = [x.toFixed(2), y.toFixed(2), degrees, v.toFixed(2), w.toFixed(2)];
      this.#rows.get(name).cells.forEach((cell, column) => setText(cell, texts[column]));
    });
    setText(byId("words"), this.#sentences(poses, driven).join(" · "));
  }

  /** For a screen reader; called now and then, as it is read aloud. */
  describeField(poses) {
    byId("turtles").setAttribute("aria-label", fieldInWords(this.#names, poses));
  }

  showHint(missing, onSpawn) {
    const hint = byId("hint");
    hint.hidden = !missing.length;
    hint.replaceChildren(...missing.slice(0, 1).flatMap((name) => {
      const text = document.createElement("span");
      text.textContent = `A node waits for ${name}, and there is no turtle of that name yet.`;
      const button = document.createElement("button");
      button.type = "button";
      button.textContent = `Spawn ${name}`;
      button.onclick = () => onSpawn(name);
      return [text, button];
    }));
  }

  showConnection(state, text) {
    const pill = byId("connection");
    pill.dataset.state = state;
    setText(pill, text);
    byId("stage").toggleAttribute("data-stale", state === "lost");
  }

  announce(text) {
    byId("announcer").textContent = text;
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
    row.insertCell().append(button);
    const cells = Array.from({ length: 5 }, () => row.insertCell());
    this.#rows.set(name, { button, cells });
    return row;
  }

  #sentences(poses, driven) {
    const drivenAt = this.#names.indexOf(driven);
    if (drivenAt < 0) return [];
    return this.#names
      .map((name, k) => ({ name, k }))
      .filter(({ k }) => k !== drivenAt)
      .slice(0, MOST_SENTENCES)
      .map(({ name, k }) => placeInWords(driven, name, seenFrom(poses[k], poses[drivenAt])));
  }

  #announceChanges(names) {
    const came = names.filter((name) => !this.#names.includes(name));
    const went = this.#names.filter((name) => !names.includes(name));
    const parts = [
      came.length && `${came.slice(0, 5).join(", ")} appeared`,
      went.length && `${went.slice(0, 5).join(", ")} left`,
    ];
    const text = parts.filter(Boolean).join("; ");
    if (text) this.announce(text);
  }
}

function setText(element, text) {
  if (element.textContent !== text) element.textContent = text;
}
