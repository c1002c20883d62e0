// Pause, go back in time, and for a bag play at any speed.

import { byId, setText } from "../kit/dom.js";
import { timeInWords } from "./words.js";

const NOW_SECONDS = 0.25; // nearer to the newest is now

export class TimeBar {
  /** Whether the source is a bag: it plays, and has no "now". */
  isBag = false;
  #send;
  #state = null;
  #dragging = false;

  /** `send(command)` to the server. */
  constructor(send) {
    this.#send = send;
    byId("pause").onclick = () => this.toggle();
    byId("now").onclick = () => this.now();
    byId("speed").onchange = ({ target }) => send({ type: "speed", factor: Number(target.value) });
    const scrub = byId("scrub");
    scrub.oninput = () => send({ type: "seek", stamp: Number(scrub.value) });
    scrub.onpointerdown = () => { this.#dragging = true; };
    for (const type of ["pointerup", "pointercancel"]) {
      scrub.addEventListener(type, () => { this.#dragging = false; });
    }
  }

  /** Whether the time stands still. */
  get isPaused() {
    return this.#state !== null && !this.#isRunning;
  }

  /** Pause or go on. */
  toggle() {
    if (this.#state) this.#send({ type: this.#isRunning ? "pause" : "play" });
  }

  /** Show what comes in now. */
  now() {
    if (this.#state && !this.isBag) this.#send({ type: "play" });
  }

  /** The server's `time` packet. */
  show(time) {
    this.#state = time;
    const { oldest, newest, now, speed } = time;
    const running = this.#isRunning;
    const scrub = byId("scrub");
    scrub.disabled = !(newest > oldest);
    if (newest > oldest) Object.assign(scrub, { min: oldest, max: newest });
    if (newest > oldest && !this.#dragging) scrub.value = this.#isLive ? newest : now;
    byId("time").toggleAttribute("data-playing", running);
    byId("pause").setAttribute("aria-label", running ? "Pause" : this.isBag ? "Play" : "Go on");
    byId("speed").hidden = !this.isBag;
    if (document.activeElement !== byId("speed")) byId("speed").value = String(speed ?? 1);
    byId("now").hidden = this.isBag;
    byId("now").disabled = this.#isLive;
    byId("now").toggleAttribute("data-live", this.#isLive);
    setText(byId("now"), this.#isLive ? "Live" : "Now");
    setText(byId("clock"), this.#clockText(time));
    scrub.setAttribute("aria-valuetext", byId("clock").textContent);
  }

  get #isRunning() {
    return this.isBag ? Boolean(this.#state.playing) : Boolean(this.#state.live);
  }

  get #isLive() {
    return !this.isBag && Boolean(this.#state.live);
  }

  #clockText({ now, oldest, newest, simulated }) {
    if (this.isBag) return `${(now - oldest).toFixed(2)} of ${(newest - oldest).toFixed(2)} s`;
    if (!(now > 0)) return "nothing moves yet";
    const back = newest - now;
    if (!this.#isLive) return back > NOW_SECONDS ? `${back.toFixed(1)} s ago` : "paused";
    return simulated ? `${timeInWords(now)} simulated` : timeInWords(now);
  }
}
