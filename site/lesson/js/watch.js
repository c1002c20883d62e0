// Beside the field: the TF tree, echoes, the log, the doctor, and faults to practise on.

import { FramesPanel } from "../turtlesim/frames_panel.js";

const MOST_LINES = 300;
const byId = (id) => document.getElementById(id);

export class Watch {
  #frames = new FramesPanel((chosen) => (this.#chosen = chosen ?? {}));
  #chosen = {};
  #lines = [];
  #topics = "";
  #firstTopic = "";

  /** `examine()` asks for the doctor's report; `onFaults()` after a fault was switched. */
  constructor(examine, onFaults) {
    byId("examine").onclick = () => {
      byId("doctor").textContent = "Listening for two seconds …";
      examine();
    };
    byId("faults").addEventListener("change", onFaults);
    byId("log").addEventListener("keydown", (event) => event.stopPropagation());
  }

  /** Another lesson: which topic to echo first, and which faults there are. */
  open({ topic, faults }) {
    this.#firstTopic = topic || "/turtle1/pose";
    byId("faults-card").hidden = !faults.length;
    byId("faults").replaceChildren(...faults.map(({ name, label }) => {
      const [row, box] = [document.createElement("label"), document.createElement("input")];
      box.type = "checkbox";
      box.value = name;
      row.append(box, label);
      return row;
    }));
  }

  /** Names of the faults that are switched on. */
  get faults() {
    return [...byId("faults").querySelectorAll(":checked")].map(({ value }) => value);
  }

  /** What Python shall look at in the next step. */
  get wishes() {
    return { ...this.#chosen, topic: byId("topic").value };
  }

  clear() {
    this.#lines = [];
    for (const id of ["log", "topic-echo", "tf-echo", "doctor"]) byId(id).textContent = "";
  }

  show(message) {
    if (message.type === "tf") this.#frames.show(message);
    else if (message.type === "echo") this.#echo(message);
    else if (message.type === "doctor") byId("doctor").textContent = message.text;
  }

  log({ text }) {
    this.#lines.push(text);
    if (this.#lines.length > MOST_LINES) this.#lines.splice(0, this.#lines.length - MOST_LINES);
    const box = byId("log");
    const isAtEnd = box.scrollHeight - box.scrollTop - box.clientHeight < 30;
    box.textContent = this.#lines.join("\n");
    if (isAtEnd) box.scrollTop = box.scrollHeight;
  }

  #echo({ seconds, topics, topic, transform }) {
    byId("clock").textContent =
      `${seconds.toFixed(1)} s · drive turtle1 with the arrow keys or the pad`;
    byId("topic-echo").textContent = topic;
    byId("tf-echo").textContent = transform;
    if (topics.join() === this.#topics) return;
    this.#topics = topics.join();
    const select = byId("topic");
    const chosen = [select.value, this.#firstTopic].find((name) => topics.includes(name));
    select.replaceChildren(...topics.map((name) => new Option(name, name, false, name === chosen)));
  }
}
