// Where things are, said in plain words.

/** Where `other` is as `observer` sees it: metres ahead and metres to the left. */
export function seenFrom(observer, other) {
  const [dx, dy] = [other.x - observer.x, other.y - observer.y];
  const [cos, sin] = [Math.cos(observer.theta), Math.sin(observer.theta)];
  return { ahead: cos * dx + sin * dy, left: -sin * dx + cos * dy };
}

/** "turtle1 is 2.16 m ahead and 0.90 m to the left of turtle2" */
export function placeInWords(otherName, observerName, { ahead, left }) {
  const parts = [];
  if (Math.abs(ahead) >= 0.005) parts.push(`${Math.abs(ahead).toFixed(2)} m ${ahead > 0 ? "ahead" : "behind"}`);
  if (Math.abs(left) >= 0.005) parts.push(`${Math.abs(left).toFixed(2)} m to the ${left > 0 ? "left" : "right"}`);
  if (!parts.length) return `${otherName} is where ${observerName} is`;
  return `${otherName} is ${parts.join(" and ")}${parts.at(-1).endsWith("behind") ? "" : " of"} ${observerName}`;
}

/** What a listener hears of the whole field. */
export function fieldInWords(names, poses) {
  if (!names.length) return "The field, without a turtle";
  const some = names.slice(0, 8).map((name, k) => `${name} at ${poses[k].x.toFixed(1)}, ${poses[k].y.toFixed(1)}`);
  const rest = names.length > 8 ? ` and ${names.length - 8} more` : "";
  return `The field, 11 by 11 metres, with ${some.join("; ")}${rest}`;
}
