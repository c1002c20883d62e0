// The frames of the stream, and the place between two of them at which the display is.

export const FIELD_METRES = 499 / 45;
export const IMAGE_PIXELS = 500;
export const PIXELS_PER_METRE = 45;
const TICK_MS = 16;
const POSE_FLOATS = 5;
const STROKE_WORDS = 5;
const JUMP_METRES = 1.5;

/**
 * The frame in a packet. Poses are [x, y, theta, v, w] for each turtle; strokes are [colour and
 * width, x0, y0, x1, y1].
 */
export function frameOf({ tick, version, restart, arrays: { poses, strokes } }) {
  return {
    tick,
    version,
    restart,
    poses,
    turtleCount: poses.length / POSE_FLOATS,
    strokes: {
      count: strokes.length / STROKE_WORDS,
      points: new Float32Array(strokes.buffer, strokes.byteOffset, strokes.length),
      pens: strokes,
    },
  };
}

/** The pose of turtle `index` in a frame. */
export function poseOf(frame, index) {
  const at = POSE_FLOATS * index;
  const [x, y, theta, v, w] = frame.poses.subarray(at, at + POSE_FLOATS);
  return { x, y, theta, v, w };
}

/** Plays frames a little late, so that turtles move smoothly at any display rate. */
export class Playback {
  // In frames, which are one tick apart, with a crowd two, and more when the machine is busy.
  static #DELAY = 1.5;
  static #LONGEST_GAP = 4; // [ticks]
  static #KEPT = 16;
  #frames = [];
  #head = 0;
  #lastTime = 0;
  /** How many times faster than real time the ticks come; 0 in a pause. */
  speed = 1;

  push(frame) {
    const newest = this.#frames.at(-1);
    if (newest && (frame.version !== newest.version || frame.tick < newest.tick)) this.#frames = [];
    this.#frames.push(frame);
    if (this.#frames.length > Playback.#KEPT) this.#frames.shift();
  }

  get newest() {
    return this.#frames.at(-1) ?? null;
  }

  /**
   * Poses at the display's time `now` [ms], and the axes of frames if they came with the poses, or
   * null while there is no frame.
   */
  sample(now) {
    if (!this.#frames.length) return null;
    this.#advance(now);
    let i = this.#frames.length - 1;
    while (i > 0 && this.#frames[i].tick > this.#head) i -= 1;
    const a = this.#frames[i];
    const b = this.#frames[i + 1] ?? a;
    const share = (this.#head - a.tick) / (b.tick - a.tick);
    const part = b.tick > a.tick ? Math.min(1, Math.max(0, share)) : 1;
    const pose = (k) => between(poseOf(a, k), poseOf(b, k), part);
    const poses = Array.from({ length: a.turtleCount }, (_, k) => pose(k));
    return { poses, axes: axesBetween(a.axes, b.axes, part) };
  }

  #advance(now) {
    const newest = this.#frames.at(-1).tick;
    const gap = Math.max(1, newest - (this.#frames.at(-2)?.tick ?? newest));
    const target = newest - Playback.#DELAY * Math.min(gap, Playback.#LONGEST_GAP);
    this.#head += ((now - this.#lastTime) / TICK_MS) * (this.speed || 1);
    this.#lastTime = now;
    const late = target - this.#head;
    this.#head = Math.abs(late) > 8 ? target : this.#head + 0.08 * late;
  }
}

/** Maps of name to numbers that begin with x and y; null while no axes are sent. */
function axesBetween(a, b, part) {
  if (!a || !b) return null;
  const entry = ([name, end]) => {
    const start = a[name] ?? end;
    const jumps = Math.hypot(end[0] - start[0], end[1] - start[1]) > JUMP_METRES;
    return [name, jumps ? end : end.map((value, k) => start[k] + part * (value - start[k]))];
  };
  return new Map(Object.entries(b).map(entry));
}

function between(a, b, part) {
  if (Math.hypot(b.x - a.x, b.y - a.y) > JUMP_METRES) return b; // a teleport, not a movement
  const turn = Math.atan2(Math.sin(b.theta - a.theta), Math.cos(b.theta - a.theta));
  const [x, y] = [a.x + part * (b.x - a.x), a.y + part * (b.y - a.y)];
  return { ...b, x, y, theta: a.theta + part * turn };
}
