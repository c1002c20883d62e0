// One joint: its name, its value in figures, and a slider or a dial.

import { makeDial } from "./dial.js";

const DEGREES = 180 / Math.PI;
const SLIDER_STEPS = 10000;
/** Part of the range that a press of + or − moves. */
const NUDGE = 0.01;

export class JointRow {
  element = document.createElement("section");
  #joint;
  #set;
  #position = 0;
  #unit;
  #value = document.createElement("input");
  #unitName = document.createElement("span");
  #small = document.createElement("small");
  #control;

  /** `joint` as the node describes it; `set(position)` sends a new position [rad or m]. */
  constructor(joint, set) {
    this.#joint = joint;
    this.#set = set;
    this.element.className = "joint";
    this.element.dataset.name = joint.name;
    this.element.toggleAttribute("data-mimic", joint.mimic !== null);
    this.element.setAttribute("aria-label", joint.name);
    const endless = joint.kind === "continuous";
    this.element.toggleAttribute("data-dial", endless);
    this.#control = endless ? this.#makeDial() : this.#makeSlider();
    this.element.append(this.#makeName(), this.#makeValue(), this.#small);
    if (endless) this.element.append(this.#control.element);
    if (joint.mimic === null) {
      this.element.append(this.#makeSteps(endless ? null : this.#control.element));
      this.#listen();
    }
  }

  /** Show angles in degrees or radians. */
  setUnit(degrees) {
    this.#unit = unitOf(this.#joint.kind, degrees);
    this.#unitName.textContent = this.#unit.name;
    this.#small.textContent = this.#details();
    this.show(this.#position, true);
  }

  /** Show a position [rad or m]. While a value is typed, that stays as it is. */
  show(position, always = false) {
    this.#position = position;
    if (always || document.activeElement !== this.#value) {
      this.#value.value = shown(position, this.#unit);
    }
    this.#control?.show(position);
  }

  matches(words) {
    const name = this.#joint.name.toLowerCase();
    return words.every((word) => name.includes(word));
  }

  #details() {
    const { kind, mimic, minimum, maximum, max_velocity: velocity } = this.#joint;
    if (mimic !== null) return formula(mimic, this.#unit);
    const unit = this.#unit.name;
    const range = `${shown(minimum, this.#unit)} to ${shown(maximum, this.#unit)} ${unit}`;
    const parts = kind === "continuous" ? [kind] : [kind, range];
    if (velocity) parts.push(`at most ${shown(velocity, this.#unit)} ${unit}/s`);
    return parts.join(", ");
  }

  #makeName() {
    const name = document.createElement("b");
    name.textContent = this.#joint.name;
    return name;
  }

  #makeValue() {
    const box = document.createElement("div");
    box.className = "value";
    this.#value.type = "number";
    this.#value.step = "any";
    this.#value.disabled = this.#joint.mimic !== null;
    this.#value.setAttribute("aria-label", `value of ${this.#joint.name}`);
    this.#value.onchange = () => {
      const position = this.#value.valueAsNumber / this.#unit.scale;
      if (Number.isFinite(position)) this.#changeEndlessly(position);
      this.show(this.#position, true);
    };
    box.append(this.#value, this.#unitName);
    return box;
  }

  /** The buttons for a little less and a little more, with the slider between them if there is. */
  #makeSteps(slider) {
    const box = document.createElement("div");
    box.className = "steps";
    const [less, more] = [["−", -1], ["+", 1]].map(([text, side]) => {
      const button = document.createElement("button");
      button.type = "button";
      button.textContent = text;
      button.setAttribute("aria-label", `${side < 0 ? "less" : "more"} ${this.#joint.name}`);
      button.onclick = () => this.#nudge(side);
      return button;
    });
    box.append(...[less, slider, more].filter(Boolean));
    return box;
  }

  #makeSlider() {
    const { minimum, maximum, mimic, name } = this.#joint;
    if (mimic !== null) return null;
    const slider = document.createElement("input");
    slider.type = "range";
    [slider.min, slider.max, slider.step] = [0, SLIDER_STEPS, 1];
    slider.setAttribute("aria-label", name);
    const range = maximum - minimum;
    slider.oninput = () => this.#change(minimum + (slider.valueAsNumber / SLIDER_STEPS) * range);
    return {
      element: slider,
      show: (position) => {
        slider.value = range > 0 ? ((position - minimum) / range) * SLIDER_STEPS : 0;
        slider.setAttribute("aria-valuetext", `${shown(position, this.#unit)} ${this.#unit.name}`);
      },
    };
  }

  #makeDial() {
    const free = this.#joint.mimic === null;
    const dial = makeDial(free ? (by) => this.#change(wrapped(this.#position + by)) : null);
    dial.element.setAttribute("role", free ? "slider" : "img");
    dial.element.setAttribute("aria-label", this.#joint.name);
    if (free) dial.element.setAttribute("tabindex", "0");
    return {
      element: dial.element,
      show: (position) => {
        dial.show(position);
        if (free) dial.element.setAttribute("aria-valuenow", position.toFixed(3));
      },
    };
  }

  #listen() {
    this.#control.element.addEventListener("dblclick", () => this.#change(this.#joint.zero));
    this.element.addEventListener("keydown", (event) => {
      if (event.target === this.#value || event.ctrlKey || event.metaKey || event.altKey) return;
      const dial = event.target === this.#control.element;
      const steps = {
        "+": 1, "=": 1, "-": -1,
        ...(dial && { ArrowUp: 1, ArrowRight: 1, ArrowDown: -1, ArrowLeft: -1 }),
      };
      if (!(event.key in steps)) return;
      event.preventDefault();
      this.#nudge(steps[event.key]);
    });
  }

  #nudge(side) {
    const { minimum, maximum } = this.#joint;
    this.#changeEndlessly(this.#position + side * NUDGE * (maximum - minimum));
  }

  /** An endless joint takes any angle; others stop at their limits. */
  #changeEndlessly(position) {
    this.#change(this.#joint.kind === "continuous" ? wrapped(position) : position);
  }

  #change(position) {
    const { minimum, maximum } = this.#joint;
    const within = Math.min(Math.max(position, minimum), maximum);
    this.show(within);
    this.#set(within);
  }
}

/** The same angle from −π to π. */
function wrapped(angle) {
  return Math.atan2(Math.sin(angle), Math.cos(angle));
}

/** The unit of a joint: its name, how many of it make a radian or metre, and its decimals. */
function unitOf(kind, degrees) {
  if (kind === "prismatic") return { name: "m", scale: 1, digits: 3 };
  return degrees ? { name: "°", scale: DEGREES, digits: 1 } : { name: "rad", scale: 1, digits: 3 };
}

/** A number with the unit's decimals; never "-0.000". */
function shown(value, { scale, digits }) {
  const text = (value * scale).toFixed(digits);
  return Number(text) === 0 ? (0).toFixed(digits) : text;
}

/** "= -0.5 · elbow + 0.25", in the unit of the joint. */
function formula({ parent, factor, offset }, unit) {
  const product = factor === 1 ? parent : `${short(factor)} · ${parent}`;
  if (offset === 0) return `= ${product}`;
  return `= ${product} ${offset < 0 ? "−" : "+"} ${short(Math.abs(offset) * unit.scale)}`;
}

function short(number) {
  return String(Number(number.toPrecision(6)));
}
