// The worker that runs Python: one request at a time, and a watch on code that does not end.

import { addressOf } from "./files.js";

// How long Python may give no sign of life: as long as its start took, within these limits, so that
// a slow phone is not taken for an endless loop.
const SHORTEST_MS = 3000;
const LONGEST_MS = 15_000;
const MERCY_MS = 2000; // after the request to stop
const LOADING_MS = 120_000;
const SIGINT = 2;

export class Runtime {
  #worker = null;
  #load;
  #handlers;
  #pending = null;
  #watch = null;
  #flag = null;
  #limit = LONGEST_MS;
  #queue = Promise.resolve();
  #loaded = null;

  /**
   * `files`: the address, or the blob, of each file of the page by its path; `handlers`:
   * onStage(name, text) while Python is loaded, onLog({ lines }), onResult(result),
   * onRestarted() after Python was reloaded, onLost(error) if that failed.
   */
  constructor(files, handlers) {
    this.#load = { type: "load", files };
    this.#handlers = handlers;
  }

  /** Load Python, or reload it; requests wait until it is there. */
  load() {
    this.#loaded = this.#start();
    return this.#loaded;
  }

  async #start() {
    this.#worker?.terminate();
    this.#worker = new Worker(addressOf("js/worker.js"));
    this.#worker.onmessage = ({ data }) => this.#take(data);
    this.#worker.onerror = (event) => this.#take({ type: "failed", text: event.message });
    if (crossOriginIsolated) this.#flag = new Uint8Array(new SharedArrayBuffer(1));
    const begin = performance.now();
    await this.#ask({ ...this.#load, interruptBuffer: this.#flag }, LOADING_MS);
    this.#limit = Math.min(LONGEST_MS, Math.max(SHORTEST_MS, performance.now() - begin));
  }

  /**
   * Ask after all earlier requests are done. The answer has `stopped: true` if it was too slow,
   * `broken` with a text if the code brought Python down, and `restarted: true` if Python had to be
   * restarted for one of them.
   */
  request(message) {
    const answer = this.#queue.then(() => this.#loaded).then(() => this.#ask(message, this.#limit));
    this.#queue = answer.catch(() => {});
    return answer;
  }

  #ask(message, limit) {
    return new Promise((resolve, reject) => {
      const isLoad = message.type === "load";
      this.#pending = { resolve, reject, limit, isLoad, interrupted: false };
      this.#expectLife();
      this.#worker.postMessage(message);
    });
  }

  #take({ type, ...rest }) {
    if (type === "log") this.#handlers.onLog(rest);
    else if (type === "stage") this.#handlers.onStage(rest.name, rest.text);
    else if (!this.#pending) return;
    else if (type === "alive") this.#expectLife();
    else if (type === "result") {
      this.#expectLife();
      this.#handlers.onResult(rest.result);
    } else this.#finish(type, rest);
  }

  #finish(type, rest) {
    clearTimeout(this.#watch);
    const { resolve, reject, isLoad, interrupted } = this.#pending;
    if (type === "failed" && !isLoad) {
      this.#restart({ broken: rest.text });
      return;
    }
    this.#pending = null;
    if (this.#flag) this.#flag[0] = 0;
    if (type === "failed") reject(new Error(rest.text));
    else resolve({ ...rest, stopped: interrupted });
  }

  #expectLife() {
    clearTimeout(this.#watch);
    this.#watch = setTimeout(() => this.#stop(), this.#pending.limit);
  }

  /** Interrupt Python where the page is isolated; otherwise, or if that fails, restart it. */
  #stop() {
    if (this.#flag && !this.#pending.interrupted) {
      this.#pending.interrupted = true;
      this.#flag[0] = SIGINT;
      this.#watch = setTimeout(() => this.#stop(), MERCY_MS);
    } else if (this.#pending.isLoad) this.#take({ type: "failed", text: "Python did not start" });
    else this.#restart({ stopped: true });
  }

  /** Restart Python, and answer what was asked at once. */
  #restart(answer) {
    const { resolve } = this.#pending;
    this.#pending = null;
    this.load().then(this.#handlers.onRestarted, this.#handlers.onLost);
    resolve({ ...answer, restarted: true, texts: [], frame: null, mistake: null });
  }
}
