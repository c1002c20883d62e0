// The field: two canvases on top of each other. The ground changes when something is drawn, the turtles with every display frame.

import { FIELD_METRES, IMAGE_PIXELS, PIXELS_PER_METRE } from "./frames.js";
import { lookOf } from "./looks.js";
import { Trails } from "./trails.js";
import { drawTurtle } from "./turtle_art.js";

const SPRITE_METRES = 1.3;
const STRIDES = 12;
const MOST_NAMES = 60;

export class Field {
  #ground;
  #live;
  #trails = new Trails();
  #background = [69, 86, 255];
  #sprites = new Map();
  #size = 0;
  #strides = new Map();
  #still = matchMedia("(prefers-reduced-motion: reduce)");

  constructor(groundCanvas, liveCanvas) {
    this.#ground = groundCanvas.getContext("2d");
    this.#live = liveCanvas.getContext("2d");
    new ResizeObserver(() => this.#resize()).observe(liveCanvas);
    this.#resize();
  }

  setBackground(rgb) {
    this.#background = rgb;
    this.#paintGround();
  }

  addStrokes(strokes, restart) {
    const first = restart ? 0 : this.#trails.count;
    if (restart) this.#trails.clear();
    this.#trails.append(strokes);
    if (restart || this.#trails.count < first) this.#paintGround();
    else if (strokes.count) this.#trails.draw(this.#ground, this.#size, first);
  }

  /** Draw turtles: `names` and `poses` in the same order, `driven` is the name that gets the ring. */
  drawTurtles(names, poses, driven, now) {
    const ctx = this.#live;
    ctx.setTransform(1, 0, 0, 1, 0, 0);
    ctx.clearRect(0, 0, this.#size, this.#size);
    poses.forEach((pose, k) => this.#drawTurtle(names[k], pose, names[k] === driven, now));
    if (poses.length <= MOST_NAMES) poses.forEach((pose, k) => this.#drawName(names[k], pose));
  }

  /** Forget the swing of turtles that are gone. */
  keepOnly(names) {
    for (const name of this.#strides.keys()) if (!names.includes(name)) this.#strides.delete(name);
  }

  get #scale() {
    return (this.#size / IMAGE_PIXELS) * PIXELS_PER_METRE;
  }

  #toCanvas({ x, y }) {
    const half = 0.5 * (this.#size / IMAGE_PIXELS); // positions are at the centres of the original's pixels
    return [x * this.#scale + half, (FIELD_METRES - y) * this.#scale + half];
  }

  #resize() {
    const box = this.#live.canvas.getBoundingClientRect();
    const size = Math.max(1, Math.round(box.width * devicePixelRatio));
    if (size === this.#size) return;
    this.#size = size;
    for (const { canvas } of [this.#ground, this.#live]) canvas.width = canvas.height = size;
    this.#sprites.clear();
    this.#paintGround();
  }

  #paintGround() {
    const ctx = this.#ground;
    const size = this.#size;
    ctx.fillStyle = `rgb(${this.#background.join(" ")})`;
    ctx.fillRect(0, 0, size, size);
    const light = ctx.createRadialGradient(0.35 * size, 0.25 * size, 0, 0.5 * size, 0.5 * size, 0.8 * size);
    light.addColorStop(0, "rgb(255 255 255 / 9%)");
    light.addColorStop(1, "rgb(0 0 20 / 14%)");
    ctx.fillStyle = light;
    ctx.fillRect(0, 0, size, size);
    this.#paintGrid();
    this.#trails.draw(ctx, size);
  }

  #paintGrid() {
    const ctx = this.#ground;
    const font = Math.max(9 * devicePixelRatio, this.#size / 62);
    ctx.font = `${font}px system-ui, sans-serif`;
    ctx.fillStyle = "rgb(255 255 255 / 42%)";
    ctx.lineWidth = Math.max(1, this.#size / 1000);
    for (let metre = 0; metre <= FIELD_METRES; metre += 1) {
      const [x, y] = this.#toCanvas({ x: metre, y: metre });
      ctx.strokeStyle = metre % 5 ? "rgb(255 255 255 / 7%)" : "rgb(255 255 255 / 16%)";
      ctx.beginPath();
      ctx.moveTo(x, 0);
      ctx.lineTo(x, this.#size);
      ctx.moveTo(0, y);
      ctx.lineTo(this.#size, y);
      ctx.stroke();
      if (metre === 0 || metre === 11) continue;
      ctx.textAlign = "center";
      ctx.textBaseline = "bottom";
      ctx.fillText(`${metre}`, x, this.#size - 0.35 * font);
      ctx.textAlign = "left";
      ctx.textBaseline = "middle";
      ctx.fillText(metre === 10 ? "10 m" : `${metre}`, 0.45 * font, y);
    }
  }

  #drawTurtle(name, pose, isDriven, now) {
    const ctx = this.#live;
    const [x, y] = this.#toCanvas(pose);
    if (isDriven) this.#drawRing(x, y);
    const sprite = this.#sprite(name, this.#stride(name, pose, now));
    ctx.setTransform(Math.cos(pose.theta), -Math.sin(pose.theta), Math.sin(pose.theta), Math.cos(pose.theta), x, y);
    ctx.drawImage(sprite, -sprite.width / 2, -sprite.height / 2);
    ctx.setTransform(1, 0, 0, 1, 0, 0);
  }

  #drawRing(x, y) {
    const ctx = this.#live;
    ctx.strokeStyle = "rgb(255 255 255 / 40%)";
    ctx.lineWidth = 0.02 * this.#scale;
    ctx.setLineDash([0.09 * this.#scale, 0.07 * this.#scale]);
    ctx.beginPath();
    ctx.arc(x, y, 0.66 * this.#scale, 0, 2 * Math.PI);
    ctx.stroke();
    ctx.setLineDash([]);
  }

  #drawName(name, pose) {
    const ctx = this.#live;
    const font = Math.max(11 * devicePixelRatio, 0.25 * this.#scale);
    const [x, below] = this.#toCanvas({ x: pose.x, y: pose.y - 0.78 });
    ctx.font = `600 ${font}px system-ui, sans-serif`;
    const width = ctx.measureText(name).width + 1.1 * font;
    const left = Math.min(Math.max(x - width / 2, 4), this.#size - width - 4);
    const top = below > this.#size - 1.2 * font ? this.#toCanvas({ x: 0, y: pose.y + 0.78 })[1] - 0.75 * font : below - 0.75 * font;
    ctx.fillStyle = "rgb(12 17 60 / 55%)";
    ctx.beginPath();
    ctx.roundRect(left, top, width, 1.5 * font, 0.75 * font);
    ctx.fill();
    ctx.fillStyle = "#ffffff";
    ctx.textAlign = "center";
    ctx.textBaseline = "middle";
    ctx.fillText(name, left + width / 2, top + 0.79 * font);
  }

  /** Which of the swings of the flippers to show; faster turtles row faster. */
  #stride(name, pose, now) {
    if (this.#still.matches) return STRIDES / 4;
    const state = this.#strides.get(name) ?? { phase: 0, time: now };
    const effort = Math.min(3, Math.abs(pose.v) + 0.4 * Math.abs(pose.w));
    state.phase = (state.phase + 0.0055 * effort * (now - state.time)) % (2 * Math.PI);
    state.time = now;
    this.#strides.set(name, state);
    return Math.floor((state.phase / (2 * Math.PI)) * STRIDES) % STRIDES;
  }

  #sprite(name, stride) {
    const look = lookOf(name);
    const key = `${look.shell}${stride}`;
    let sprite = this.#sprites.get(key);
    if (!sprite) {
      sprite = document.createElement("canvas");
      sprite.width = sprite.height = Math.ceil(SPRITE_METRES * this.#scale);
      const ctx = sprite.getContext("2d");
      ctx.translate(sprite.width / 2, sprite.height / 2);
      ctx.scale(this.#scale, this.#scale);
      drawTurtle(ctx, look, Math.sin((2 * Math.PI * stride) / STRIDES));
      this.#sprites.set(key, sprite);
    }
    return sprite;
  }
}
