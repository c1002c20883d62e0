// Numbers as texts: ages, rates, times, metres.

const STALE_SECONDS = 1;
const SYSTEM_TIME = 1e9; // a larger stamp is a date

/** "12 ms old", "3.2 s old", "2.0 s in the future". */
export function ageInWords(seconds) {
  if (seconds < -STALE_SECONDS) return `${(-seconds).toFixed(1)} s in the future`;
  if (seconds >= STALE_SECONDS) return `${seconds.toFixed(1)} s old`;
  return `${Math.max(0, 1000 * seconds).toFixed(0)} ms old`;
}

/** "62 Hz", below ten "0.5 Hz". */
export function rateInWords(hertz) {
  return `${hertz.toFixed(hertz < 9.95 ? 1 : 0)} Hz`;
}

/** How late a transform comes: "0.7 ms", "2.5 s". */
export function delayInWords(seconds) {
  const isLong = Math.abs(seconds) >= 1;
  return isLong ? `${seconds.toFixed(1)} s` : `${(1000 * seconds).toFixed(1)} ms`;
}

/** What the tree says under a name: "62 Hz · 12 ms old", "static". */
export function readingInWords(row) {
  if (!row) return "";
  if (row.parent === null || row.parent === undefined || row.parent === "") return "root";
  const parts = row.static ? ["static"] : [];
  if (!row.static && isNumber(row.rate)) parts.push(rateInWords(row.rate));
  if (!row.static && isNumber(row.age)) parts.push(ageInWords(row.age));
  if (row.publisher) parts.push(publisherInWords(row));
  return parts.join(" · ");
}

/** The nodes that sent a frame, marked if they have left. */
export function publisherInWords(row) {
  return row.departed ? `${row.publisher} (has left)` : row.publisher;
}

/** "live", "static", "stale" or "root": how the tree marks a frame. */
export function kindOf(row) {
  if (!row || !row.parent) return "root";
  if (row.static) return "static";
  if (row.departed) return "stale";
  return isNumber(row.age) && Math.abs(row.age) > STALE_SECONDS ? "stale" : "live";
}

export function isNumber(value) {
  return typeof value === "number" && Number.isFinite(value);
}

/** With this number of digits; a number that rounds to zero has no sign. */
export function fixed(value, digits) {
  return value.toFixed(digits).replace(/^-(0(\.0*)?)$/, "$1");
}

/** Numbers in a row, or "not finite". */
export function numbersInWords(values, digits = 3) {
  return values.map((value) => (isNumber(value) ? fixed(value, digits) : "not finite")).join(", ");
}

/** Time of day for system time, else seconds. */
export function timeInWords(seconds) {
  if (Math.abs(seconds) < SYSTEM_TIME) return `${seconds.toFixed(2)} s`;
  const date = new Date(1000 * seconds);
  const tenths = Math.floor((((seconds % 1) + 1) % 1) * 10);
  return `${date.toLocaleTimeString("en-GB")}.${tenths}`;
}
