// The field: two canvases on top of each other. The ground changes when a pen draws, the turtles
// with every display frame.

import { drawAxes } from "./axes.js";
import { Camera } from "./camera.js";
import { FIELD_METRES, IMAGE_PIXELS, PIXELS_PER_METRE } from "./frames.js";
import { paintGround } from "./ground.js";
import { Trails } from "./trails.js";
import { TurtlePainter } from "./turtle_painter.js";

const PIXEL_CENTRE = 0.5; // positions are at the centres of the original's pixels

export class Field {
  #ground;
  #live;
  #trails = new Trails();
  #painter = new TurtlePainter();
  #camera = new Camera();
  #background = [69, 86, 255];
  #size = 0;
  #pixelsToCss = 1;

  constructor(groundCanvas, liveCanvas) {
    this.#ground = groundCanvas.getContext("2d");
    this.#live = liveCanvas.getContext("2d");
    new ResizeObserver(() => this.#fitToScreen()).observe(liveCanvas);
    this.#fitToScreen();
  }

  get canvas() {
    return this.#live.canvas;
  }

  get follows() {
    return this.#camera.follows;
  }

  setBackground(rgb) {
    if (rgb.join() === this.#background.join()) return;
    this.#background = rgb;
    this.#repaint();
  }

  setFollow(follow) {
    this.#camera.setFollow(follow);
    this.#resize();
  }

  addStrokes(strokes, restart) {
    if (restart) this.#trails.clear();
    const first = this.#trails.append(strokes);
    if (restart) this.#repaint();
    else if (strokes.count) this.#trails.draw(this.#ground, this.#ground.canvas.width, first);
  }

  /**
   * Draw a display frame: `names` and `poses` in the same order, `driven` is the name that gets the
   * ring, `ghost` a turtle that is being placed, as { name, x, y, theta }, or null, and `axes` the
   * frames to draw, as { frames, from, to } for drawAxes, or null.
   */
  drawTurtles(names, poses, { driven, ghost, axes, now }) {
    this.#lookAt(poses[names.indexOf(driven)], now);
    const ctx = this.#live;
    ctx.setTransform(1, 0, 0, 1, 0, 0);
    ctx.clearRect(0, 0, this.#size, this.#size);
    this.#painter.paint(ctx, {
      turtles: poses.map((pose, k) => ({ name: names[k], pose, at: this.#toCanvas(pose) })),
      ghost: ghost && { ...ghost, at: this.#toCanvas(ghost) },
      driven,
      scale: this.#scale,
      now,
      above: (label, taken) => axes && this.#drawAxes(axes, names, label, taken),
    });
  }

  /** Forget the swing of turtles that are gone. */
  keepOnly(names) {
    this.#painter.keepOnly(names);
  }

  /** The place in the field [m] below a pointer event. */
  placeOf({ clientX, clientY }) {
    const box = this.canvas.getBoundingClientRect();
    const scale = this.#size / box.width;
    const [x, y] = [(clientX - box.left) * scale, (clientY - box.top) * scale];
    const half = PIXEL_CENTRE * (this.#scale / PIXELS_PER_METRE);
    const metres = (pixels) => (pixels - half) / this.#scale;
    return { x: metres(x + this.#camera.left), y: FIELD_METRES - metres(y + this.#camera.top) };
  }

  /** What is seen, as a PNG. */
  picture() {
    const canvas = document.createElement("canvas");
    canvas.width = canvas.height = this.#size;
    const ctx = canvas.getContext("2d");
    ctx.drawImage(this.#ground.canvas, -this.#camera.left, -this.#camera.top);
    ctx.drawImage(this.canvas, 0, 0);
    return new Promise((resolve) => canvas.toBlob(resolve, "image/png"));
  }

  /** Canvas pixels to the metre. */
  get #scale() {
    return (this.#size / IMAGE_PIXELS) * PIXELS_PER_METRE * this.#camera.zoom;
  }

  #toCanvas({ x, y }) {
    const half = PIXEL_CENTRE * (this.#scale / PIXELS_PER_METRE);
    const pixels = (metres) => metres * this.#scale + half;
    return [pixels(x) - this.#camera.left, pixels(FIELD_METRES - y) - this.#camera.top];
  }

  #drawAxes(axes, names, label, taken) {
    const toCanvas = (place) => this.#toCanvas(place);
    const named = (name) => names.includes(name);
    drawAxes(this.#live, { ...axes, named, toCanvas, scale: this.#scale, label, taken });
  }

  #lookAt(pose, now) {
    if (!pose || !this.follows) this.#camera.rest();
    else {
      const [x, y] = [pose.x / FIELD_METRES, 1 - pose.y / FIELD_METRES];
      this.#camera.look(x * this.#size, y * this.#size, this.#size, now);
    }
    const { left, top } = this.#camera;
    const [x, y] = [-left * this.#pixelsToCss, -top * this.#pixelsToCss];
    this.#ground.canvas.style.transform = `translate(${x}px, ${y}px)`;
  }

  #fitToScreen() {
    const { width } = this.canvas.getBoundingClientRect();
    const size = Math.max(1, Math.round(width * devicePixelRatio));
    this.#pixelsToCss = width / size;
    if (size === this.#size) return;
    this.#size = size;
    this.canvas.width = this.canvas.height = size;
    this.#resize();
  }

  #resize() {
    const ground = this.#ground.canvas;
    ground.width = ground.height = Math.round(this.#size * this.#camera.zoom);
    ground.style.width = ground.style.height = `${100 * this.#camera.zoom}%`;
    this.#repaint();
  }

  #repaint() {
    paintGround(this.#ground, this.#background);
    this.#trails.draw(this.#ground, this.#ground.canvas.width);
  }
}
