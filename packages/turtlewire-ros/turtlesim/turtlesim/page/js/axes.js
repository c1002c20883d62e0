// The frames on the field: their axes as TF has them, and the arrow from one frame to another with
// its components along the axes of the first.

const X_COLOUR = "#ff6b78";
const Y_COLOUR = "#5df0a2";
const EDGE = "rgb(12 17 60 / 70%)";
const AXIS_METRES = 0.75;
const SHORT_METRES = 0.25; // a shorter component gets no number
const STEPS_ASIDE = [0, 1, -1, 2, -2, 3, -3]; // of its height, to a place without a name

/**
 * Draw on `ctx`. `frames`: Map of name to [x, y, and the directions of its two axes seen from
 * above]; `from`, `to`: the frames of the arrow, or null; `named(name)`: whether the field names
 * the frame anyway; `toCanvas({ x, y })`: canvas pixels; `scale`: canvas pixels per metre;
 * `label(name, at)` writes a name; `taken`: the boxes of all names, which numbers avoid.
 */
export function drawAxes(ctx, { frames, from, to, named, toCanvas, scale, label, taken }) {
  const arrow = from !== to && frames.has(from) && frames.has(to);
  if (arrow) drawArrow(ctx, frames.get(from), frames.get(to), toCanvas, scale);
  for (const [x, y, ...axes] of frames.values()) {
    const at = (metres, [dx, dy]) => toCanvas({ x: x + metres * dx, y: y + metres * dy });
    const lines = [[axes.slice(2), Y_COLOUR], [axes.slice(0, 2), X_COLOUR]];
    for (const [direction, colour] of lines) {
      line(ctx, at(0, direction), at(AXIS_METRES, direction), 0.05 * scale, colour, true);
    }
    dot(ctx, toCanvas({ x, y }), 0.06 * scale);
  }
  const isSeen = (place) => place.every((at) => at >= 0 && at <= ctx.canvas.width);
  for (const [name, [x, y]] of frames) {
    const place = toCanvas({ x, y });
    if (!named(name) && isSeen(place)) label(name, place);
  }
  if (!arrow) return;
  for (const [a, b, text, colour] of writtenComponents(frames.get(from), frames.get(to))) {
    taken.push(number(ctx, toCanvas(a), toCanvas(b), { text, colour, scale, taken }));
  }
}

/** Metres along both axes of a frame, and the corner where the first component ends. */
function components([x, y, xx, xy, yx, yy], [toX, toY]) {
  const [dx, dy] = [toX - x, toY - y];
  const ahead = xx * dx + xy * dy;
  return { ahead, left: yx * dx + yy * dy, corner: { x: x + ahead * xx, y: y + ahead * xy } };
}

function drawArrow(ctx, start, end, toCanvas, scale) {
  const [a, b] = [start, end].map(([x, y]) => toCanvas({ x, y }));
  const corner = toCanvas(components(start, end).corner);
  ctx.setLineDash([0.13 * scale, 0.11 * scale]);
  line(ctx, a, corner, 0.035 * scale, X_COLOUR, false);
  line(ctx, corner, b, 0.035 * scale, Y_COLOUR, false);
  ctx.setLineDash([]);
  line(ctx, a, b, 0.045 * scale, "#ffffff", true);
}

/** The components that are long enough: begin and end of the line, text and colour. */
function writtenComponents(start, end) {
  const { ahead, left, corner } = components(start, end);
  const [a, b] = [start, end].map(([x, y]) => ({ x, y }));
  const lines = [[ahead, a, corner, "x", X_COLOUR], [left, corner, b, "y", Y_COLOUR]];
  return lines.filter(([metres]) => Math.abs(metres) > SHORT_METRES).map(
    ([metres, begin, stop, axis, colour]) => [begin, stop, `${axis} ${metres.toFixed(2)}`, colour],
  );
}

/** A line, with a head at its end if `pointed`; its dark edge shows it on any background. */
function line(ctx, [x0, y0], [x1, y1], width, colour, pointed) {
  const length = Math.hypot(x1 - x0, y1 - y0);
  if (length < 1) return;
  const [ux, uy] = [(x1 - x0) / length, (y1 - y0) / length];
  const head = pointed ? Math.min(4.5 * width, length / 2) : 0;
  ctx.lineCap = "butt";
  for (const [edge, style] of [[0.6 * width, EDGE], [0, colour]]) {
    ctx.strokeStyle = ctx.fillStyle = style;
    ctx.lineWidth = width + edge;
    ctx.beginPath();
    ctx.moveTo(x0, y0);
    ctx.lineTo(x1 - 0.9 * head * ux, y1 - 0.9 * head * uy);
    ctx.stroke();
    if (!pointed) continue;
    const [long, wide] = [head + edge / 2, 0.42 * head + edge / 2];
    const [tipX, tipY] = [x1 + (edge / 2) * ux, y1 + (edge / 2) * uy];
    ctx.beginPath();
    ctx.moveTo(tipX, tipY);
    ctx.lineTo(tipX - long * ux - wide * uy, tipY - long * uy + wide * ux);
    ctx.lineTo(tipX - long * ux + wide * uy, tipY - long * uy - wide * ux);
    ctx.fill();
  }
}

function dot(ctx, [x, y], radius) {
  ctx.fillStyle = "#ffffff";
  ctx.beginPath();
  ctx.arc(x, y, radius, 0, 2 * Math.PI);
  ctx.fill();
}

/**
 * Write a component's number in the middle of its line or, where a name is, above or below it, and
 * inside of the canvas; the box that it takes.
 */
function number(ctx, [x0, y0], [x1, y1], { text, colour, scale, taken }) {
  const font = Math.max(12 * devicePixelRatio, 0.24 * scale);
  ctx.font = `600 ${font}px system-ui, sans-serif`;
  const [width, height] = [ctx.measureText(text).width + 0.9 * font, 1.45 * font];
  const size = ctx.canvas.width;
  const inside = (at, extent) => Math.min(Math.max(at - extent / 2, 4), size - extent - 4);
  const boxes = STEPS_ASIDE.map((step) => ({
    left: inside((x0 + x1) / 2, width),
    top: inside((y0 + y1) / 2 + step * height, height),
    width,
    height,
  }));
  const isFree = (box) => !taken.some((other) => overlap(box, other));
  const box = boxes.find(isFree) ?? boxes[0];
  const { left, top } = box;
  ctx.fillStyle = "rgb(12 17 60 / 90%)";
  ctx.beginPath();
  ctx.roundRect(left, top, width, height, height / 2);
  ctx.fill();
  ctx.fillStyle = colour;
  ctx.textAlign = "center";
  ctx.textBaseline = "middle";
  ctx.fillText(text, left + width / 2, top + 0.53 * height);
  return box;
}

function overlap(a, b) {
  const apart = a.left > b.left + b.width || b.left > a.left + a.width ||
    a.top > b.top + b.height || b.top > a.top + a.height;
  return !apart;
}
