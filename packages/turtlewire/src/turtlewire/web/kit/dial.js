// A knob for a joint that turns endlessly: drag around its middle, or use the keys.

const TICKS = Array.from({ length: 12 }, (_, k) => (k * Math.PI) / 6)
  .map((at) => `M${40 + 32 * Math.cos(at)} ${40 + 32 * Math.sin(at)}L${point(at, 36)}`)
  .join("");

/** The element, and `show(angle)` [rad]. `turn(by)` is called with each turn of a drag. */
export function makeDial(turn) {
  const element = document.createElementNS("http://www.w3.org/2000/svg", "svg");
  element.setAttribute("viewBox", "0 0 80 80");
  element.setAttribute("class", "dial");
  element.innerHTML =
    `<circle cx="40" cy="40" r="38"/><path d="${TICKS}"/><path class="hand" d="M40 40H68"/>`;
  const hand = element.querySelector(".hand");
  if (turn) listenForDrags(element, turn);
  return {
    element,
    show: (angle) => hand.setAttribute("transform", `rotate(${(-angle * 180) / Math.PI} 40 40)`),
  };
}

function listenForDrags(element, turn) {
  let last = null;
  const angleOf = ({ clientX, clientY }) => {
    const { left, top, width, height } = element.getBoundingClientRect();
    return Math.atan2(top + height / 2 - clientY, clientX - left - width / 2);
  };
  element.onpointerdown = (event) => {
    element.setPointerCapture(event.pointerId);
    last = angleOf(event);
  };
  element.onpointermove = (event) => {
    if (last === null) return;
    const angle = angleOf(event);
    const by = angle - last;
    turn(Math.atan2(Math.sin(by), Math.cos(by)));
    last = angle;
  };
  element.onpointerup = element.onpointercancel = () => {
    last = null;
  };
}

function point(at, radius) {
  return `${40 + radius * Math.cos(at)} ${40 + radius * Math.sin(at)}`;
}
