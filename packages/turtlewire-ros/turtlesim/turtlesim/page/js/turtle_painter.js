// Draws turtles, their names and rings onto a canvas; each look and each swing of the flippers is
// drawn once and kept.

import { lookOf } from "./looks.js";
import { drawTurtle } from "./turtle_art.js";

const SPRITE_METRES = 1.06; // no larger than the art: a crowd's time goes into copying pixels
const STRIDES = 12;
const MOST_NAMES = 60;
const LONGEST_LABEL = 18;
const CROWD = 100; // more turtles than this do not swing, and turn in steps
const HEADINGS = 48;
const FULL_TURN = 2 * Math.PI;

export class TurtlePainter {
  #sprites = new Map();
  #spriteScale = 0;
  #swings = new Map();
  #still = matchMedia("(prefers-reduced-motion: reduce)");

  /**
   * `turtles`: [{ name, pose, at: [x, y] }] in canvas pixels; `scale`: canvas pixels per metre;
   * `above(label, taken)`: draws what lies over the turtles, and below the driven one's name;
   * `taken`: the boxes of all names, which its own texts avoid; the rest as in Field. The driven
   * turtle lies on the others, and nothing on its name.
   */
  paint(ctx, { turtles, ghost, driven, scale, now, above }) {
    if (scale !== this.#spriteScale) this.#sprites.clear();
    this.#spriteScale = scale;
    const crowded = turtles.length > CROWD;
    const draw = ({ name, pose, at }) => {
      if (crowded) this.#stamp(ctx, name, at, pose.theta);
      else this.#put(ctx, name, at, pose.theta, this.#stride(name, pose, now));
    };
    const others = turtles.filter(({ name }) => name !== driven);
    const top = turtles.find(({ name }) => name === driven);
    others.forEach(draw);
    const named = turtles.length > MOST_NAMES ? [] : others;
    const taken = named.map(({ name, at }) => label(ctx, name, at, scale));
    if (top) taken.push(boxOf(ctx, driven, top.at, scale));
    if (top) {
      ring(ctx, top.at, scale);
      draw(top);
    }
    if (ghost) {
      ctx.globalAlpha = 0.6;
      this.#put(ctx, ghost.name, ghost.at, ghost.theta, 0);
      ctx.globalAlpha = 1;
    }
    above((name, at) => taken.push(label(ctx, name, at, 0.4 * scale)), taken);
    if (top) label(ctx, driven, top.at, scale, "rgb(12 17 60 / 86%)");
  }

  keepOnly(names) {
    const wanted = new Set(names);
    for (const name of this.#swings.keys()) if (!wanted.has(name)) this.#swings.delete(name);
  }

  #put(ctx, name, [x, y], theta, stride) {
    const sprite = this.#sprite(name, stride);
    ctx.setTransform(Math.cos(theta), -Math.sin(theta), Math.sin(theta), Math.cos(theta), x, y);
    ctx.drawImage(sprite, -sprite.width / 2, -sprite.height / 2);
    ctx.setTransform(1, 0, 0, 1, 0, 0);
  }

  /** Copy a turned turtle: without a graphics card this is ten times faster than turning one. */
  #stamp(ctx, name, [x, y], theta) {
    const heading = ((Math.round((theta / FULL_TURN) * HEADINGS) % HEADINGS) + HEADINGS) % HEADINGS;
    const sprite = this.#sprite(name, 0, heading);
    ctx.drawImage(sprite, Math.round(x - sprite.width / 2), Math.round(y - sprite.height / 2));
  }

  /** Which of the swings to show; faster turtles row faster. */
  #stride(name, pose, now) {
    if (this.#still.matches) return 0;
    const swing = this.#swings.get(name) ?? { phase: 0, time: now };
    const effort = Math.min(3, Math.abs(pose.v) + 0.4 * Math.abs(pose.w));
    swing.phase = (swing.phase + 0.0055 * effort * (now - swing.time)) % FULL_TURN;
    swing.time = now;
    this.#swings.set(name, swing);
    return Math.floor((swing.phase / FULL_TURN) * STRIDES) % STRIDES;
  }

  #sprite(name, stride, heading = 0) {
    const look = lookOf(name);
    const key = `${look.shell} ${stride} ${heading}`;
    let sprite = this.#sprites.get(key);
    if (!sprite) {
      sprite = document.createElement("canvas");
      sprite.width = sprite.height = Math.ceil(SPRITE_METRES * this.#spriteScale);
      const ctx = sprite.getContext("2d");
      ctx.translate(sprite.width / 2, sprite.height / 2);
      ctx.rotate((-FULL_TURN * heading) / HEADINGS);
      ctx.scale(this.#spriteScale, this.#spriteScale);
      drawTurtle(ctx, look, Math.sin((FULL_TURN * stride) / STRIDES));
      this.#sprites.set(key, sprite);
    }
    return sprite;
  }
}

function ring(ctx, [x, y], scale) {
  ctx.strokeStyle = "rgb(255 255 255 / 40%)";
  ctx.lineWidth = 0.02 * scale;
  ctx.setLineDash([0.09 * scale, 0.07 * scale]);
  ctx.beginPath();
  ctx.arc(x, y, 0.66 * scale, 0, FULL_TURN);
  ctx.stroke();
  ctx.setLineDash([]);
}

function shortened(name) {
  const half = LONGEST_LABEL / 2;
  return name.length > LONGEST_LABEL ? `${name.slice(0, half)}…${name.slice(1 - half)}` : name;
}

/**
 * Where a name stands: below the turtle, above it at the lower edge, and always inside of the
 * canvas. It sets the font.
 */
function boxOf(ctx, name, [x, y], scale) {
  const size = ctx.canvas.width;
  const font = Math.max(12 * devicePixelRatio, size / 45);
  ctx.font = `600 ${font}px system-ui, sans-serif`;
  const width = ctx.measureText(shortened(name)).width + 1.1 * font;
  const left = Math.min(Math.max(x - width / 2, 4), size - width - 4);
  const below = y + 0.72 * scale;
  const beside = below > size - 1.6 * font ? y - 0.72 * scale - 1.5 * font : below;
  const top = Math.min(Math.max(beside, 4), size - 1.5 * font - 4);
  return { left, top, width, height: 1.5 * font };
}

/** Write a name; the box that it takes. */
function label(ctx, name, at, scale, fill = "rgb(12 17 60 / 64%)") {
  const box = boxOf(ctx, name, at, scale);
  const { left, top, width, height } = box;
  ctx.fillStyle = fill;
  ctx.beginPath();
  ctx.roundRect(left, top, width, height, height / 2);
  ctx.fill();
  ctx.fillStyle = "#ffffff";
  ctx.textAlign = "center";
  ctx.textBaseline = "middle";
  ctx.fillText(shortened(name), left + width / 2, top + 0.53 * height);
  return box;
}
