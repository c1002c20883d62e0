// Positions in plain words.

const NOTHING_METRES = 0.005;
const NOTHING_DEGREES = 0.5;

/** The place of `other` relative to `observer`, in the plane: metres ahead and to the left. */
export function seenFrom(observer, other) {
  const [dx, dy] = [other.x - observer.x, other.y - observer.y];
  const [cos, sin] = [Math.cos(observer.theta), Math.sin(observer.theta)];
  return { ahead: cos * dx + sin * dy, left: -sin * dx + cos * dy };
}

/** "turtle1 is 2.16 m ahead and 0.90 m to the left of turtle2" */
export function placeInWords(otherName, observerName, { ahead, left, up = 0 }) {
  const parts = [
    [ahead, "ahead", "behind"],
    [left, "to the left", "to the right"],
    [up, "above", "below"],
  ]
    .filter(([metres]) => Math.abs(metres) >= NOTHING_METRES)
    .map(([metres, positive, negative]) => {
      return `${Math.abs(metres).toFixed(2)} m ${metres > 0 ? positive : negative}`;
    });
  if (!parts.length) return `${otherName} is where ${observerName} is`;
  const head = parts.slice(0, -1).join(", ");
  const list = parts.length > 1 ? `${head} and ${parts.at(-1)}` : parts.join();
  const of = /(behind|above|below)$/.test(list) ? "" : " of";
  return `${otherName} is ${list}${of} ${observerName}`;
}

/** The same for a transform, which may also turn: translation [m] and rotation (xyzw). */
export function transformInWords(sourceName, targetName, { translation, rotation }) {
  if ([...translation, ...rotation].includes(null)) {
    return `${sourceName} has no finite position in ${targetName}`;
  }
  const [ahead, left, up] = translation;
  const place = placeInWords(sourceName, targetName, { ahead, left, up });
  const [x, y, z, w] = rotation;
  const yaw = (Math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z)) * 180) / Math.PI;
  if (Math.abs(yaw) < NOTHING_DEGREES) return `${place}, and looks the same way`;
  const side = yaw > 0 ? "left" : "right";
  return `${place}, and looks ${Math.abs(yaw).toFixed(0)}° further to the ${side}`;
}

/** What a listener hears of the whole field. */
export function fieldInWords(names, poses) {
  if (!names.length) return "The field, without a turtle";
  const place = ({ x, y }) => `${x.toFixed(1)}, ${y.toFixed(1)}`;
  const some = names.slice(0, 8).map((name, k) => `${name} at ${place(poses[k])}`);
  const rest = names.length > 8 ? ` and ${names.length - 8} more` : "";
  return `The field, 11 by 11 metres, with ${some.join("; ")}${rest}`;
}

/** How the simulation goes. */
export function paceInWords(speed) {
  if (speed === 0) return "paused";
  return speed === 1 ? "live" : `live, ${speed} ×`;
}
