// Numbers and policies as people read them.

/** 0.5 Hz, 62.5 Hz, 1000 Hz. */
export function rateInWords(rate) {
  return `${rate.toFixed(rate < 99.95 ? 1 : 0)} Hz`;
}

/** 512 B/s, 1.2 kB/s, 30 MB/s. */
export function bandwidthInWords(bytes) {
  const units = ["B/s", "kB/s", "MB/s", "GB/s"];
  const power = Math.min(3, Math.max(0, Math.floor(Math.log10(Math.max(bytes, 1)) / 3)));
  const number = bytes / 1000 ** power;
  return `${number.toFixed(power && number < 9.95 ? 1 : 0)} ${units[power]}`;
}

/** Only what is not as in ROS 2's default profile stands behind the first two. */
export function qosInWords(qos) {
  const words = [qos.reliability, qos.durability].map((word) => word.replaceAll("_", " "));
  words.push(qos.depth === null ? qos.history.replaceAll("_", " ") : `depth ${qos.depth}`);
  if (qos.deadline_ns) words.push(`deadline ${qos.deadline_ns / 1e9} s`);
  if (qos.lifespan_ns) words.push(`lifespan ${qos.lifespan_ns / 1e9} s`);
  if (qos.liveliness === "manual_by_topic") words.push("liveliness manual by topic");
  if (qos.liveliness_lease_duration_ns) {
    words.push(`lease ${qos.liveliness_lease_duration_ns / 1e9} s`);
  }
  return words.join(" · ");
}

/** "1 node", "2 nodes". */
export function count(number, word) {
  return `${number} ${word}${number === 1 ? "" : number && word.endsWith("h") ? "es" : "s"}`;
}
