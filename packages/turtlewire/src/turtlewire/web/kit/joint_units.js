// Numbers as people read them: radians or degrees for joints that turn, metres for others.

const DEGREES = 180 / Math.PI;

/** The unit of a joint: its name, how many of it make a radian or metre, and its decimals. */
export function unitOf(kind, degrees) {
  if (kind === "prismatic") return { name: "m", scale: 1, digits: 3 };
  return degrees ? { name: "°", scale: DEGREES, digits: 1 } : { name: "rad", scale: 1, digits: 3 };
}

/** A number with the unit's decimals; never "-0.000". */
export function shown(value, { scale, digits }) {
  const text = (value * scale).toFixed(digits);
  return Number(text) === 0 ? (0).toFixed(digits) : text;
}

/** "= -0.5 · elbow + 0.25", in the unit of the joint. */
export function formula({ parent, factor, offset }, unit) {
  const product = factor === 1 ? parent : `${short(factor)} · ${parent}`;
  if (offset === 0) return `= ${product}`;
  return `= ${product} ${offset < 0 ? "−" : "+"} ${short(Math.abs(offset) * unit.scale)}`;
}

function short(number) {
  return String(Number(number.toPrecision(6)));
}
