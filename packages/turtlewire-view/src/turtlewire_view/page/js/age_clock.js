// How long ago each frame's stamp changed, as RViz counts it, and how it fades.

export const TIMEOUT_SECONDS = 15;

/**
 * A frame is as old as the time since its newest common time with the fixed frame changed, by this
 * page's clock: a bag of last year does not fade. Static frames have the stamp 0 and stay fresh.
 */
export class AgeClock {
  #names = [];
  #stamps = new Float64Array(0);
  #changed = new Float64Array(0);
  #static = new Uint8Array(0);
  #clock;
  #now = 0;
  #pausedAt = null;
  #paused = 0;

  /** `clock()`: seconds; the tests give their own. */
  constructor(clock = () => performance.now() / 1000) {
    this.#clock = clock;
  }

  /** A new set of frames; those that stay keep their age. */
  rename(names) {
    const former = new Map(this.#names.map((name, k) => [name, k]));
    const kept = names.map((name) => former.get(name));
    const now = this.tick();
    this.#stamps = Float64Array.from(kept, (k) => (k === undefined ? -1 : this.#stamps[k]));
    this.#changed = Float64Array.from(kept, (k) => (k === undefined ? now : this.#changed[k]));
    this.#static = new Uint8Array(names.length);
    this.#names = names;
  }

  /** The frames' newest stamps; what changed is fresh. */
  take(stamps, known) {
    const now = this.tick();
    for (let k = 0; k < stamps.length; k += 1) {
      this.#static[k] = known[k] && stamps[k] === 0 ? 1 : 0;
      if (stamps[k] === this.#stamps[k]) continue;
      this.#stamps[k] = stamps[k];
      this.#changed[k] = now;
    }
  }

  /** While the view is paused nothing grows older. */
  setPaused(paused) {
    const now = this.#clock();
    if (paused && this.#pausedAt === null) this.#pausedAt = now;
    else if (!paused && this.#pausedAt !== null) {
      this.#paused += now - this.#pausedAt;
      this.#pausedAt = null;
    }
  }

  /** Read the clock, for the calls until the next one; the seconds without pauses. */
  tick() {
    this.#now = (this.#pausedAt ?? this.#clock()) - this.#paused;
    return this.#now;
  }

  /** Seconds since the frame's stamp changed; 0 for a static one. */
  age(k) {
    return this.#static[k] ? 0 : this.#now - this.#changed[k];
  }

  isAlive(k) {
    return this.age(k) <= TIMEOUT_SECONDS;
  }

  /** How grey (0 to 1) a frame is after a third of the time, and how opaque in the last third. */
  fading(k) {
    const third = TIMEOUT_SECONDS / 3;
    const age = this.age(k);
    return {
      grey: Math.min(1, Math.max(0, age / third - 1)),
      alpha: Math.min(1, Math.max(0, 3 - age / third)),
    };
  }

  /** Whether the picture changes with time alone. */
  get isFading() {
    if (this.#pausedAt !== null) return false;
    const first = TIMEOUT_SECONDS / 3;
    for (let k = 0; k < this.#names.length; k += 1) {
      const age = this.age(k);
      if (age > first && age < TIMEOUT_SECONDS + 1) return true;
    }
    return false;
  }
}
