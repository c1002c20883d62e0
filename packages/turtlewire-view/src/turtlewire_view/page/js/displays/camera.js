// Camera: a window with an image, and over it the scene as the camera sees it.

import { PerspectiveCamera } from "three";

import { clear } from "./parts/common.js";
import { Pictures, PictureWindow } from "./parts/picture_window.js";

const NEAR = 0.01; // [m], as in RViz
/** Longest side of what is drawn of the scene [pixels]. */
const LARGEST_SIDE = 960;

export default class CameraDisplay {
  #view;
  #options;
  #window;
  #pictures = new Pictures();
  #picture = null; // { picture, width, height }
  #projection = null;
  #group = null;
  #camera = new PerspectiveCamera();
  #layer = new OffscreenCanvas(1, 1);
  #isVisible = true;
  #end;

  constructor(view, options) {
    this.#view = view;
    this.#options = options;
    this.#window = new PictureWindow(() => view.hide());
    this.#camera.rotation.x = Math.PI; // an optical frame looks along z, y goes down
    this.#end = view.afterDraw(() => this.#draw());
  }

  async show(group, header, arrays, shapes) {
    clear(group);
    group.add(this.#camera);
    this.#group = group;
    try {
      const read = await this.#pictures.read(header, arrays, shapes);
      if (!read) return;
      this.#picture?.picture.close?.();
      this.#picture = read;
      this.#projection = header.projection;
      this.#label(header);
      this.#window.fit(read.picture.width, read.picture.height);
      this.#view.report?.("");
    } catch (error) {
      this.#view.report?.(error.message);
    }
    this.#view.requestDraw();
  }

  removed() {
    this.#group = null;
  }

  setVisible(isVisible) {
    this.#isVisible = isVisible;
    this.#window.setVisible(isVisible);
  }

  setOptions(options) {
    this.#options = options;
  }

  dispose() {
    this.#pictures.stop();
    this.#end();
    this.#picture?.picture.close?.();
    this.#picture = null;
    this.#window.remove();
  }

  /** After each picture of the page. */
  #draw() {
    if (!this.#picture || !this.#isVisible) return;
    const { rendering, alpha, zoom } = this.#options;
    const { canvas } = this.#window;
    const ink = canvas.getContext("2d");
    ink.clearRect(0, 0, canvas.width, canvas.height);
    if (rendering !== "overlay") this.#drawImage(ink, zoom, 1);
    if (this.#group?.visible) this.#drawScene(ink);
    if (rendering !== "background") this.#drawImage(ink, zoom, alpha);
  }

  /** The image about the middle of the window, larger by the zoom. */
  #drawImage(ink, zoom, alpha) {
    const { width, height } = ink.canvas;
    ink.globalAlpha = alpha;
    ink.drawImage(
      this.#picture.picture, (width - width * zoom) / 2, (height - height * zoom) / 2,
      width * zoom, height * zoom,
    );
    ink.globalAlpha = 1;
  }

  #drawScene(ink) {
    const size = this.#sizeOnScreen(ink.canvas);
    this.#aim();
    const { show_frames: hasFrames, show_grid: hasGrid } = this.#options;
    const hidden = [...(hasFrames ? [] : ["frames"]), ...(hasGrid ? [] : ["grid"])];
    const image = this.#view.pictureFrom(this.#camera, ...size, hidden);
    [this.#layer.width, this.#layer.height] = size;
    this.#layer.getContext("2d").putImageData(image, 0, 0);
    ink.drawImage(this.#layer, 0, 0, ink.canvas.width, ink.canvas.height);
  }

  /** The pixels that the window has on the screen, at most the largest side. */
  #sizeOnScreen({ width, height, clientWidth }) {
    const wide = Math.min(LARGEST_SIDE, (clientWidth || width) * devicePixelRatio);
    const factor = wide / Math.max(width, height, 1);
    return [width, height].map((side) => Math.max(1, Math.round(side * factor)));
  }

  /** RViz's projection: the camera's own, larger by the zoom. */
  #aim() {
    const { fx, fy, cx, cy, tx, ty, width, height } = this.#projection;
    const { zoom, far } = this.#options;
    const depth = far - NEAR;
    this.#camera.near = NEAR;
    this.#camera.far = far;
    this.#camera.position.set(tx, ty, 0);
    this.#camera.projectionMatrix.set(
      (2 * fx * zoom) / width, 0, 2 * (0.5 - cx / width) * zoom, 0,
      0, (2 * fy * zoom) / height, 2 * (cy / height - 0.5) * zoom, 0,
      0, 0, -(far + NEAR) / depth, (-2 * far * NEAR) / depth,
      0, 0, -1, 0,
    );
    this.#camera.projectionMatrixInverse.copy(this.#camera.projectionMatrix).invert();
    this.#camera.updateWorldMatrix(true, false);
    this.#camera.matrixWorldInverse.copy(this.#camera.matrixWorld).invert();
  }

  #label({ encoding, camera }) {
    const { width, height } = this.#picture;
    this.#window.label(this.#view.topic, `camera · ${width} × ${height} · ${encoding} · ${camera}`);
  }
}
