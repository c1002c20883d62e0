// One student: the field in small, and what is known of the nodes.

import { setText } from "../kit/dom.js";

const FIELD_M = 11.09;
const TRAIL = 150;
const COLOURS = ["#ffd54a", "#7cf0c0", "#ff9db0", "#b6c3ff", "#ffffff", "#ffb36b"];
const LEAP_M = 2;

function element(tag, className, parent) {
  const made = document.createElement(tag);
  made.className = className;
  parent.append(made);
  return made;
}

function ago(seconds) {
  if (seconds === null) return "nothing seen yet";
  if (seconds < 3) return "active now";
  if (seconds < 90) return `quiet for ${seconds} s`;
  return `quiet for ${Math.round(seconds / 60)} min`;
}

export class Card {
  constructor() {
    this.element = document.createElement("article");
    const head = element("div", "head", this.element);
    this.name = element("h2", "", head);
    this.domain = element("span", "quiet small", head);
    this.canvas = element("canvas", "", this.element);
    this.canvas.setAttribute("role", "img");
    this.state = element("p", "state", this.element);
    this.follow = element("p", "small", this.element);
    this.problem = element("p", "problem small", this.element);
    this.remedy = element("p", "small remedy", this.element);
    this.nodes = element("p", "quiet small nodes", this.element);
    this.trails = new Map();
  }

  update(seat, kind) {
    this.element.className = kind;
    setText(this.name, seat.name);
    const domain = `domain ${seat.domain}`;
    setText(this.domain, seat.name.toLowerCase() === domain ? "" : domain);
    const running = seat.count === 1 ? "1 node" : `${seat.count} nodes`;
    setText(this.state, `${seat.count ? running : "Nothing runs"} · ${ago(seat.idle)}`);
    setText(this.follow, this.#transforms(seat));
    setText(this.problem, seat.problem?.text ?? "");
    setText(this.remedy, seat.problem?.remedy ?? "");
    const more = seat.count > seat.nodes.length ? " …" : "";
    this.nodes.title = this.nodes.textContent;
    this.remedy.title = this.remedy.textContent;
    setText(this.nodes, seat.nodes.join(", ") + more);
    this.#paint(seat.turtles);
  }

  #transforms(seat) {
    if (!seat.count || seat.frames === null) return "";
    if (seat.follow !== null) {
      return `According to TF, turtle2 is ${seat.follow.toFixed(1)} m from turtle1.`;
    }
    return seat.frames ? `${seat.frames} frames, but not of both turtles` : "No transforms yet";
  }

  #paint(turtles) {
    const { canvas } = this;
    canvas.hidden = turtles.length === 0; // a class fits on the screen before all have begun
    const side = Math.round(canvas.clientWidth * devicePixelRatio) || 200;
    if (canvas.width !== side) canvas.width = canvas.height = side;
    const context = canvas.getContext("2d");
    context.fillStyle = getComputedStyle(canvas).getPropertyValue("--field");
    context.fillRect(0, 0, side, side);
    const scale = side / FIELD_M;
    const names = new Set(turtles.map(([name]) => name));
    for (const name of this.trails.keys()) if (!names.has(name)) this.trails.delete(name);
    turtles.forEach(([name, x, y, theta], index) => {
      const colour = COLOURS[index % COLOURS.length];
      this.#trail(context, name, x, y, scale, side, colour);
      drawTurtle(context, x * scale, side - y * scale, theta, Math.max(5, side / 22), colour);
    });
    const words = turtles.map(([name, x, y]) => `${name} at ${x.toFixed(1)}, ${y.toFixed(1)}`);
    canvas.setAttribute("aria-label", words.join("; ") || "an empty field");
  }

  #trail(context, name, x, y, scale, side, colour) {
    const trail = this.trails.get(name) ?? [];
    this.trails.set(name, trail);
    const last = trail.at(-1);
    if (!last || last[0] !== x || last[1] !== y) trail.push([x, y]);
    if (trail.length > TRAIL) trail.shift();
    context.strokeStyle = colour;
    context.globalAlpha = 0.55;
    context.lineWidth = Math.max(1, side / 130);
    context.beginPath();
    trail.forEach(([px, py], index) => {
      const before = trail[index - 1];
      const leap = !before || Math.hypot(px - before[0], py - before[1]) > LEAP_M;
      context[leap ? "moveTo" : "lineTo"](px * scale, side - py * scale);
    });
    context.stroke();
    context.globalAlpha = 1;
  }
}

function drawTurtle(context, x, y, theta, size, colour) {
  context.save();
  context.translate(x, y);
  context.rotate(-theta);
  context.fillStyle = colour;
  context.strokeStyle = "#1b2238";
  context.lineWidth = size / 8;
  context.beginPath();
  context.moveTo(size, 0);
  context.lineTo(-size * 0.7, size * 0.65);
  context.lineTo(-size * 0.35, 0);
  context.lineTo(-size * 0.7, -size * 0.65);
  context.closePath();
  context.fill();
  context.stroke();
  context.restore();
}
