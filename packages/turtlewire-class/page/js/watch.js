// Next to the field: the TF tree, echoes, the log, the doctor, and faults for practice.

import { byId } from "../kit/dom.js";
import { FramesPanel } from "../turtlesim/frames_panel.js";

const MOST_LINES = 300;
const LISTENING = "Listening for three seconds …";

export class Watch {
  #frames = new FramesPanel((chosen) => (this.#chosen = chosen ?? {}));
  #chosen = {};
  #first = {};
  #lesson = {};
  #lines = [];
  #topics = "";
  #firstTopic = "";
  #offered = [];
  #hidden = null;
  #onFaults;
  #isLogDue = false;
  #isReportDue = false;

  /** `examine()` asks for the doctor's report; `onFaults()` after a fault was switched. */
  constructor(examine, onFaults) {
    this.#onFaults = onFaults;
    byId("examine").onclick = () => {
      this.#isReportDue = true;
      byId("doctor").textContent = LISTENING;
      examine();
    };
    byId("axes").onclick = ({ currentTarget }) => {
      this.#frames.draw(!this.#frames.drawn);
      currentTarget.setAttribute("aria-pressed", String(this.#frames.drawn));
    };
    byId("faults").addEventListener("change", ({ target }) => this.#choose(target));
    byId("surprise").onclick = () => this.#surprise();
    byId("log").addEventListener("keydown", (event) => event.stopPropagation());
  }

  /** Another lesson: which topic to echo first, and which faults there are. */
  open({ topic, faults, target, source }) {
    this.#lesson = { target, source };
    this.#firstTopic = topic || "/turtle1/pose";
    this.#offered = faults;
    this.#hidden = null;
    this.#isReportDue = false;
    byId("guess").textContent = "";
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
    return this.#hidden ? [this.#hidden.name] : this.#checked().map(({ value }) => value);
  }

  #checked() {
    return [...byId("faults").querySelectorAll(":checked")];
  }

  /** Switch a fault on that the student has to find; the boxes are for the answer then. */
  #surprise() {
    for (const box of this.#checked()) box.checked = false;
    this.#hidden = this.#offered[Math.floor(Math.random() * this.#offered.length)];
    byId("guess").textContent = "One of these faults is active. Find it and tick it.";
    this.#onFaults();
  }

  #choose(box) {
    if (!this.#hidden) this.#onFaults();
    else if (box.value === this.#hidden.name) {
      byId("guess").textContent = `Found. ${this.#hidden.label}. It is still active: untick it.`;
      this.#hidden = null;
    } else {
      box.checked = false;
      byId("guess").textContent = "Not this one. What do the tree, the doctor and the log say?";
    }
  }

  /** The arrow on the field: from the frame that sees to the frame that is seen. */
  get arrow() {
    return this.#frames.arrow;
  }

  /** What Python shall look at in the next step. */
  get wishes() {
    return { ...this.#chosen, topic: byId("topic").value };
  }

  /** True from a press of "Examine" until the report arrives, across restarts. */
  get isReportDue() {
    return this.#isReportDue;
  }

  clear() {
    this.#lines = [];
    this.#first = { ...this.#lesson };
    for (const id of ["log", "topic-echo", "tf-echo"]) byId(id).textContent = "";
    byId("doctor").textContent = this.#isReportDue ? LISTENING : "";
  }

  show(message) {
    if (message.type === "tf") this.#showFrames(message);
    else if (message.type === "echo") this.#echo(message);
    else if (message.type === "doctor") {
      this.#isReportDue = false;
      byId("doctor").textContent = message.text;
    }
  }

  /** The lesson's two frames are chosen when they appear; then the choice is free. */
  #showFrames(message) {
    this.#frames.show(message);
    for (const [id, frame] of Object.entries(this.#first)) {
      if (![...byId(id).options].some(({ value }) => value === frame)) continue;
      delete this.#first[id];
      byId(id).value = frame;
      byId(id).dispatchEvent(new Event("change")); // as if it had been chosen
    }
  }

  log({ lines }) {
    this.#lines.push(...lines);
    if (this.#lines.length > 2 * MOST_LINES) this.#lines.splice(0, MOST_LINES);
    if (this.#isLogDue) return;
    this.#isLogDue = true; // once a frame, however many lines a loop prints
    requestAnimationFrame(() => this.#showLog());
  }

  #showLog() {
    this.#isLogDue = false;
    const box = byId("log");
    const isAtEnd = box.scrollHeight - box.scrollTop - box.clientHeight < 30;
    // A screen reader reads what is added to a log, and would read all of it if it were replaced.
    box.append(...this.#lines.splice(0).slice(-MOST_LINES).map((line) => `${line}\n`));
    while (box.childNodes.length > MOST_LINES) box.firstChild.remove();
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
