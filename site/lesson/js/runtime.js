// The worker that runs Python: one request at a time, and a watch on code that does not end.

import { addressOf } from "./files.js";

// How long Python may give no sign of life: as long as its start took, within these limits, so that
// a slow phone is not taken for an endless loop.
const SHORTEST_MS = 3000;
const LONGEST_MS = 15_000;
const MERCY_MS = 2000; // after it was told to stop
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

  /**
   * `files`: the address, or the blob, of each file of the page by its path; `handlers`:
   * onLog({stream, text}), onResult(result), onRestart() before Python is loaded anew.
   */
  constructor(files, handlers) {
    this.#load = { type: "load", files };
    this.#handlers = handlers;
  }

  /** Load Python, or load it anew. */
  async load() {
    this.#worker?.terminate();
    this.#worker = new Worker(addressOf("js/worker.js"));
    this.#worker.onmessage = ({ data }) => this.#take(data);
    this.#worker.onerror = (event) => this.#take({ type: "failed", text: event.message });
    if (crossOriginIsolated) this.#flag = new Uint8Array(new SharedArrayBuffer(1));
    const begin = performance.now();
    await this.#ask({ ...this.#load, interruptBuffer: this.#flag }, LOADING_MS);
    this.#limit = Math.min(LONGEST_MS, Math.max(SHORTEST_MS, performance.now() - begin));
  }

  /** Ask after all earlier requests are done. The answer has `stopped: true` if it was too slow. */
  request(message) {
    const answer = this.#queue.then(() => this.#ask(message, this.#limit));
    this.#queue = answer.catch(() => {});
    return answer;
  }

  #ask(message, limit) {
    return new Promise((resolve, reject) => {
      this.#pending = { resolve, reject, limit, interrupted: false };
      this.#expectLife();
      this.#worker.postMessage(message);
    });
  }

  #take({ type, ...rest }) {
    if (type === "log") this.#handlers.onLog(rest);
    else if (!this.#pending) return;
    else if (type === "alive") this.#expectLife();
    else if (type === "result") {
      this.#expectLife();
      this.#handlers.onResult(rest.result);
    } else this.#finish(type, rest);
  }

  #finish(type, rest) {
    clearTimeout(this.#watch);
    const { resolve, reject, interrupted } = this.#pending;
    this.#pending = null;
    if (this.#flag) this.#flag[0] = 0;
    if (type === "failed") reject(new Error(rest.text));
    else resolve({ ...rest, stopped: interrupted });
  }

  #expectLife() {
    clearTimeout(this.#watch);
    this.#watch = setTimeout(() => this.#stop(), this.#pending.limit);
  }

  /** Interrupt Python where the page is isolated; otherwise, or if that fails, start it anew. */
  #stop() {
    if (this.#flag && !this.#pending.interrupted) {
      this.#pending.interrupted = true;
      this.#flag[0] = SIGINT;
      this.#watch = setTimeout(() => this.#stop(), MERCY_MS);
    } else this.#restart();
  }

  async #restart() {
    const { resolve } = this.#pending;
    this.#pending = null;
    this.#handlers.onRestart();
    await this.load();
    resolve({ stopped: true, restarted: true, texts: [], frame: null, mistake: null });
  }
}
