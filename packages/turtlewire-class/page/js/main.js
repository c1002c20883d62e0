// The page: a lesson's text and files on one side, the running programs on the other.

import { byId } from "../kit/dom.js";
import { listenForDriving } from "../turtlesim/controls.js";
import { Editors } from "./editors.js";
import { fetchFile, filesForWorker, isFromFolder } from "./files.js";
import { Grading } from "./grading.js";
import { fetchAll, showStage } from "./loader.js";
import { Runtime } from "./runtime.js";
import { store } from "./store.js";
import { Watch } from "./watch.js";
import { World } from "./world.js";

const DRIVEN = "turtle1";
const ENDLESS = {
  text: "Your code was stopped because it did not return.",
  hint: "A callback must return, and main() must reach rclpy.spin: use a timer instead of a loop.",
};
const BROKEN = [
  [/call stack|recursion|stack overflow/i, "A function calls itself endlessly.",
    "Make it return at some point, or use a loop that ends."],
  [/out of memory|allocat|memory growth/i, "Python ran out of memory.",
    "Keep fewer or smaller objects: a tab has at most 2 to 4 GB."],
  [/exit/i, "Your code ended Python itself, and with it turtlesim and all nodes.",
    "Let main() return instead: rclpy.shutdown() ends spin()."],
  [/(?:)/, "Your code crashed Python, which has restarted.", "Click Run."],
];
const NARROW = matchMedia("(max-width: 760px)"); // as in style.css

const status = (state, text) => {
  byId("status").dataset.state = state;
  byId("status").textContent = text;
};

/** An error that is not the student's, as a mistake. */
const faultOfOurs = (error) => ({
  text: error.message,
  hint: "This is a bug in the lesson, not in your code. Click Run to start again.",
});

/** The mistake to show if Python was interrupted or restarted; otherwise nothing. */
function reasonOf({ stopped, broken }) {
  if (stopped) return ENDLESS;
  if (!broken) return {};
  const [, text, hint] = BROKEN.find(([pattern]) => pattern.test(broken));
  return { text, hint };
}

class Page {
  #lessons;
  #lesson = null;
  #runtime;
  #ready = false;
  #running = false;
  #run = 0;
  #checking = 0;
  #commands = [];
  #world = new World();
  #watch = new Watch(() => this.#examine(), () => this.run());
  #grading = new Grading(() => this.#check(), () => this.#showSolution());
  #editors = new Editors(byId("tabs"), byId("editors"), {
    onChange: (file, text) => store.keepFile(this.#lesson.id, file, text),
    onRun: () => this.run(),
  });

  constructor(lessons, runtime) {
    this.#lessons = lessons;
    this.#runtime = runtime;
    byId("run").onclick = () => {
      if (NARROW.matches) byId("field").scrollIntoView({ behavior: "smooth", block: "center" });
      return this.run();
    };
    byId("reset").onclick = () => this.#startOver();
    listenForDriving(byId("pad"), ({ linear, angular }) => {
      this.#commands.push([DRIVEN, linear, angular]);
    });
    addEventListener("hashchange", () => this.#openChosen());
  }

  get handlers() {
    return {
      onLog: (line) => this.#watch.log(line),
      onResult: (result) => this.#takeResult(result),
      onRestarted: () => this.#running || status("lost", "stopped"),
      onLost: showLost,
    };
  }

  /** Show the lesson that the address names, without running it. */
  show() {
    this.#lesson = this.#lessons.find(({ id }) => `#${id}` === location.hash) ?? this.#lessons[0];
    const text = byId("text");
    if (text.innerHTML !== this.#lesson.text) text.innerHTML = this.#lesson.text; // our own HTML
    document.title = `${this.#lesson.title} – TF2 in a tab`;
    this.#editors.open(store.filesOf(this.#lesson));
    this.#grading.clear();
    this.#watch.open(this.#lesson);
    this.#listLessons();
    byId("mistake").hidden = true;
    document.querySelector("main").dataset.state = "shown";
  }

  /** Python is loaded: enable the buttons and run. */
  begin() {
    this.#ready = true;
    for (const id of ["run", "check", "examine"]) byId(id).disabled = false;
    requestAnimationFrame((now) => this.#display(now));
    return this.run();
  }

  /** (Re)start the programs of the lesson with the files as they are. */
  async run() {
    if (!this.#ready) return; // it runs as soon as Python is loaded
    const run = (this.#run += 1);
    this.#running = false;
    this.#editors.unmark();
    byId("mistake").hidden = true;
    this.#watch.clear();
    const { id } = this.#lesson;
    const request = { type: "start", lesson: id, files: this.#editors.files };
    const started = performance.now();
    const answer = await this.#runtime.request({ ...request, faults: this.#watch.faults });
    if (run !== this.#run) return; // Run was pressed again
    byId("run").dataset.milliseconds = Math.round(performance.now() - started);
    this.#world.restart();
    if (!this.#failed(answer)) {
      this.#running = true;
      status("live", "running");
      if (this.#watch.isReportDue) this.#examine(); // it was asked of the run before
      this.#step(run).catch((error) => this.#failed({ mistake: faultOfOurs(error) }));
    }
  }

  async #step(run) {
    while (this.#running && run === this.#run) {
      const ticks = await this.#world.due();
      if (run !== this.#run) return;
      const wishes = { drive: this.#commands.splice(0), ...this.#watch.wishes };
      const answer = await this.#runtime.request({ type: "step", ticks, wishes });
      if (run !== this.#run) return;
      this.#world.axes = null;
      for (const text of answer.texts) this.#show(JSON.parse(text));
      if (answer.frame) this.#world.take(answer.frame);
      if (this.#failed(answer)) this.#running = false;
    }
  }

  #show(message) {
    if (message.type === "scene") this.#world.setScene(message);
    else if (message.type === "axes") this.#world.axes = message.frames;
    else this.#watch.show(message);
  }

  /** Show the mistake of an answer; returns true if there is one. */
  #failed({ mistake, stopped, broken, restarted }) {
    if (!mistake && !stopped && !broken) return false;
    const shown = { file: "", line: 0, hint: "", ...mistake, ...reasonOf({ stopped, broken }) };
    status("lost", restarted ? "restarting Python …" : "stopped");
    this.#editors.mark(shown);
    const where = shown.line ? `${shown.file}, line ${shown.line}: ` : "";
    const box = byId("mistake");
    const [text, hint] = [document.createElement("strong"), document.createElement("span")];
    text.textContent = where + shown.text;
    hint.textContent = shown.hint;
    box.replaceChildren(text, hint);
    box.hidden = false;
    return true;
  }

  async #check() {
    const run = (this.#checking = this.#run += 1);
    this.#running = false;
    this.#editors.unmark();
    byId("mistake").hidden = true;
    status("loading", "checking …");
    const { id } = this.#lesson;
    const request = { type: "grade", lesson: id, files: this.#editors.files };
    const answer = await this.#runtime.request(request);
    if (run !== this.#run) return;
    if (answer.restarted) {
      this.#grading.add({ check: "Came to an end", passed: false, ...reasonOf(answer) });
    }
    const next = this.#lessons[this.#lessons.indexOf(this.#lesson) + 1];
    if (this.#grading.finish(next)) store.keepSolved(id);
    this.#listLessons();
    await this.run();
  }

  #takeResult(result) {
    if (this.#checking !== this.#run) return; // another lesson was opened meanwhile
    this.#grading.add(result);
    if (!result.passed && result.line) this.#editors.mark(result);
  }

  async #examine() {
    if (this.#running) await this.#runtime.request({ type: "examine" });
  }

  #showSolution() {
    this.#editors.open({ ...this.#editors.files, ...this.#lesson.solution });
    return this.run();
  }

  #startOver() {
    store.forgetFiles(this.#lesson.id);
    this.#editors.open(this.#lesson.starter);
    this.#grading.clear();
    return this.run();
  }

  #openChosen() {
    this.show();
    return this.run();
  }

  #listLessons() {
    const items = this.#lessons.map(({ id, title }, k) => {
      const link = document.createElement("a");
      link.href = `#${id}`;
      link.textContent = k + 1;
      link.title = title;
      link.setAttribute("aria-label", `Lesson ${k + 1}: ${title}`);
      if (id === this.#lesson.id) link.setAttribute("aria-current", "page");
      if (store.isSolved(id)) link.dataset.solved = "yes";
      const item = document.createElement("li");
      item.append(link);
      return item;
    });
    byId("lessons").replaceChildren(...items);
  }

  #display(now) {
    this.#world.draw(DRIVEN, this.#watch.arrow, now);
    requestAnimationFrame((next) => this.#display(next));
  }
}

async function loadFiles(manifest) {
  const weight = `${(manifest.compressed / 1e6).toFixed(1)} MB compressed`;
  byId("loading-text").textContent = isFromFolder
    ? `Run is waiting for Python and the lesson, ${weight}, from this folder. You need no network.`
    : `Run is waiting for Python and the lesson: ${weight}, only once; then it works offline.`;
  await fetchAll(manifest.files, (done, total) => {
    byId("loading-bar").value = done / total;
    showStage("fetch", `loading, ${Math.round((100 * done) / total)} %`);
  });
}

async function main() {
  const isLoading = performance.now();
  showStage("prepare", "preparing …");
  const [lessons, manifest] = await Promise.all(
    ["lessons.json", "manifest.json"].map(async (path) => (await fetchFile(path)).json()),
  );
  let page = null;
  const runtime = new Runtime(filesForWorker(manifest.files), {
    onStage: showStage,
    onLog: (line) => page.handlers.onLog(line),
    onResult: (result) => page.handlers.onResult(result),
    onRestarted: () => page.handlers.onRestarted(),
    onLost: (error) => page.handlers.onLost(error),
  });
  page = new Page(lessons, runtime);
  page.show();
  await loadFiles(manifest);
  await runtime.load();
  showStage("run", "starting the lesson …");
  await page.begin();
  byId("loading").hidden = true;
  document.body.dataset.loadedMs = Math.round(performance.now() - isLoading);
}

/** Show a fatal error above everything: on a phone the field is far below. */
function showLost(error) {
  const main = document.querySelector("main");
  main.dataset.state = "shown";
  main.before(byId("loading"));
  byId("loading").hidden = false;
  byId("loading-bar").hidden = byId("stages").hidden = true;
  byId("loading-text").textContent =
    `The lesson could not be loaded: ${error.message}. Check the network and load the page again.`;
  status("lost", "not loaded");
}

main().catch((error) => {
  showLost(error);
  throw error;
});
