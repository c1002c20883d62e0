// The field, drawn with turtlesim's own modules, and how much simulated time is due.

import { byId } from "../kit/dom.js";
import { decodePacket } from "../kit/packets.js";
import { Field } from "../turtlesim/field.js";
import { frameOf, Playback } from "../turtlesim/frames.js";
import { fieldInWords } from "../turtlesim/words.js";

const TICK_MS = 16;
const MOST_TICKS = 12; // more than this behind, and simulated time falls back instead
const DESCRIPTION_MS = 2000;

export class World {
  #field = new Field(byId("ground"), byId("turtles"));
  #playback = new Playback();
  #names = [];
  #version = -1;
  #described = 0;
  #simulated = null;

  /** The frames of TF that the next step is drawn with, by name, or null. */
  axes = null;

  /** Another simulation begins. */
  restart() {
    this.#playback = new Playback();
    this.#names = [];
    this.#version = -1;
    this.#simulated = null;
    this.axes = null;
  }

  /** Wait for the next animation frame; how many ticks have to pass by then. */
  async due() {
    for (;;) {
      const now = await new Promise((resolve) => requestAnimationFrame(resolve));
      this.#simulated ??= now - TICK_MS;
      const ticks = Math.floor((now - this.#simulated) / TICK_MS);
      if (ticks < 1) continue;
      this.#simulated = ticks > MOST_TICKS ? now : this.#simulated + ticks * TICK_MS;
      return Math.min(ticks, MOST_TICKS);
    }
  }

  setScene({ turtles, background, version }) {
    this.#names = turtles;
    this.#version = version;
    this.#field.setBackground(background);
    this.#field.keepOnly(turtles);
  }

  /** Take the bytes of a step. */
  take(bytes) {
    const frame = frameOf(decodePacket(bytes));
    this.#field.addStrokes(frame.strokes, frame.restart);
    frame.axes = this.axes;
    this.#playback.push(frame);
  }

  /** Draw a display frame; `driven` is the turtle with the ring, `arrow` { from, to }: frames. */
  draw(driven, arrow, now) {
    const newest = this.#playback.newest;
    if (!newest || newest.turtleCount !== this.#names.length) return;
    const { poses, axes } = this.#playback.sample(now);
    const drawn = axes && { frames: axes, ...arrow };
    this.#field.drawTurtles(this.#names, poses, { driven, ghost: null, axes: drawn, now });
    if (now - this.#described < DESCRIPTION_MS) return;
    this.#described = now;
    byId("turtles").setAttribute("aria-label", fieldInWords(this.#names, poses));
  }
}
