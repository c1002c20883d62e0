// The texts around the field: positions, the driven turtle, missing turtles.

import { byId, setText } from "../kit/dom.js";
import { byName } from "../kit/names.js";
import { Roster } from "./roster.js";
import { fieldInWords, placeInWords, seenFrom } from "./words.js";

const MOST_SENTENCES = 3;

export class Panel {
  #names = [];
  #roster;

  /** `onChoose(name)`: the user wants to drive another turtle. */
  constructor(onChoose) {
    this.#roster = new Roster(onChoose);
  }

  showScene(scene, driven) {
    byId("node").textContent = scene.node;
    document.title = `turtlesim ${scene.node}`;
    this.#announceChanges(scene.turtles);
    this.#names = scene.turtles;
    this.#roster.show(scene.turtles);
    this.showDriven(driven);
  }

  showDriven(driven) {
    byId("driven").textContent = driven ?? "(no turtle)";
    this.#roster.showDriven(driven);
  }

  /** Numbers and sentences; `poses` in the scene's order. */
  showPoses(poses, driven) {
    this.#roster.showPoses(poses);
    setText(byId("words"), this.#sentences(poses, driven).join(" · "));
  }

  /** For a screen reader; called only from time to time, because it is read aloud. */
  describeField(poses) {
    byId("turtles").setAttribute("aria-label", fieldInWords(this.#names, poses));
  }

  showHint(missing, onSpawn) {
    const hint = byId("hint");
    hint.hidden = !missing.length;
    hint.replaceChildren(...missing.slice(0, 1).flatMap((name) => {
      const text = document.createElement("span");
      text.textContent = `A node is waiting for ${name}, but this turtle does not exist yet.`;
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

  #sentences(poses, driven) {
    const drivenAt = this.#names.indexOf(driven);
    if (drivenAt < 0) return [];
    return this.#names
      .map((name, k) => ({ name, k }))
      .filter(({ k }) => k !== drivenAt)
      .sort((a, b) => byName(a.name, b.name))
      .slice(0, MOST_SENTENCES)
      .map(({ name, k }) => placeInWords(driven, name, seenFrom(poses[k], poses[drivenAt])));
  }

  #announceChanges(names) {
    const came = names.filter((name) => !this.#names.includes(name)).sort(byName);
    const went = this.#names.filter((name) => !names.includes(name)).sort(byName);
    const parts = [
      came.length && `${came.slice(0, 5).join(", ")} appeared`,
      went.length && `${went.slice(0, 5).join(", ")} left`,
    ];
    const text = parts.filter(Boolean).join("; ");
    if (text) this.announce(text);
  }
}
