// The picture: renderer, light and grid; it draws only when something asks for it.
// Pictures of the scene that are not on the page's canvas: what another camera sees.

import {
  Color, DirectionalLight, Group, HemisphereLight, Object3D, PerspectiveCamera, Scene,
  SRGBColorSpace, WebGLRenderer, WebGLRenderTarget,
} from "three";

import { currentColors, onSchemeChange } from "./colors.js";
import { Grid } from "./grid.js";
import { ThickLines } from "./thick_lines.js";

const targets = new WeakMap(); // renderer to what it draws apart on

/** Draw the scene as `camera` sees it. Returns an ImageData, clear where nothing is drawn. */
export function drawApart(renderer, scene, camera, [width, height]) {
  const target = targetOf(renderer);
  target.setSize(width, height);
  const { background } = scene;
  const clear = renderer.getClearColor(new Color());
  const alpha = renderer.getClearAlpha();
  scene.background = null;
  renderer.setClearColor(0, 0);
  renderer.setRenderTarget(target);
  const bytes = new Uint8Array(4 * width * height);
  try {
    renderer.render(scene, camera);
    renderer.readRenderTargetPixels(target, 0, 0, width, height, bytes);
  } finally {
    renderer.setRenderTarget(null);
    renderer.setClearColor(clear, alpha);
    scene.background = background;
  }
  return imageOf(bytes, width, height);
}

/** What `act()` returns while some objects are hidden. */
export function without(objects, act) {
  const seen = objects.filter(({ visible }) => visible);
  for (const object of seen) object.visible = false;
  try {
    return act();
  } finally {
    for (const object of seen) object.visible = true;
  }
}

function targetOf(renderer) {
  let target = targets.get(renderer);
  if (target) return target;
  const samples = renderer.getContextAttributes().antialias ? 4 : 0;
  target = new WebGLRenderTarget(1, 1, { samples });
  // For other targets, three.js leaves some colours linear, or the driver converts them twice.
  target.isXRRenderTarget = true;
  target.texture.colorSpace = SRGBColorSpace;
  target.texture.internalFormat = "RGBA8";
  targets.set(renderer, target);
  return target;
}

/** Rows from the top, and colours that are not multiplied by their alpha. */
function imageOf(bytes, width, height) {
  const image = new ImageData(width, height);
  const row = 4 * width;
  for (let y = 0; y < height; y += 1) {
    image.data.set(bytes.subarray(row * (height - 1 - y), row * (height - y)), row * y);
  }
  const { data } = image;
  for (let k = 3; k < data.length; k += 4) {
    const alpha = data[k];
    if (alpha === 0 || alpha === 255) continue;
    for (let c = k - 3; c < k; c += 1) data[c] = (255 * data[c]) / alpha;
  }
  return image;
}

/** A renderer without a graphics card: smoothed edges and fine pixels cost too much there. */
const SOFTWARE = /SwiftShader|llvmpipe|softpipe|Basic Render/i;
const MOST_PIXELS_PER_CSS = 2;
const POWER = { powerPreference: "high-performance" };

export class View {
  scene = new Scene();
  camera = new PerspectiveCamera(50, 1, 0.01, 10_000);
  colors = currentColors();
  viewport = { width: 1, height: 1 };
  /** Whether the browser draws without a graphics card. */
  isSoftware;
  grid = new Grid();
  /** What is not the robot's: name to objects that a picture may leave out. */
  aids = { grid: [this.grid.object], frames: [], names: [] };
  /** Below this hang the displays. */
  displays = new Group();
  canvas;
  #renderer;
  #before = [];
  #after = [];
  #scheduled = false;
  #light = new DirectionalLight(0xffffff, 2.2);

  /** Raises an Error when the browser cannot draw in 3D. */
  constructor(canvas) {
    Object3D.DEFAULT_UP.set(0, 0, 1);
    this.camera.up.set(0, 0, 1);
    const context = plainContext(canvas);
    this.isSoftware = SOFTWARE.test(rendererName(context));
    ThickLines.isSoftware = this.isSoftware;
    document.documentElement.toggleAttribute("data-software", this.isSoftware);
    this.canvas = this.isSoftware ? canvas : withoutContext(canvas, context);
    const options = this.isSoftware ? { context } : { antialias: true };
    this.#renderer = new WebGLRenderer({ canvas: this.canvas, ...POWER, ...options });
    this.scene.add(new HemisphereLight(0xffffff, 0x8088a0, 1.6), this.#light, this.#light.target);
    this.scene.add(this.grid.object, this.displays);
    this.#listenForLoss();
    new ResizeObserver(() => this.#resize()).observe(this.canvas.parentElement);
    this.#resize();
    this.#takeColors(this.colors);
    onSchemeChange((colors) => this.#takeColors(colors));
  }

  /** Draw soon; many calls are one picture. */
  requestDraw() {
    if (this.#scheduled) return;
    this.#scheduled = true;
    requestAnimationFrame((now) => this.draw(now));
  }

  /** Call `act(now)` [ms] before each picture. Returns what ends that. */
  beforeDraw(act) {
    this.#before.push(act);
    return () => { this.#before = this.#before.filter((each) => each !== act); };
  }

  /** Call `act(now)` after each picture. Returns what ends that. */
  afterDraw(act) {
    this.#after.push(act);
    return () => { this.#after = this.#after.filter((each) => each !== act); };
  }

  /**
   * What another camera of the scene sees, without the names of frames: an ImageData, clear where
   * nothing is drawn. `hidden`: names of `aids` that are left out.
   */
  pictureFrom(camera, width, height, hidden = []) {
    const left = [...hidden, "names"].flatMap((name) => this.aids[name] ?? []);
    const draw = () => drawApart(this.#renderer, this.scene, camera, [width, height]);
    this.#light.position.setFromMatrixPosition(camera.matrixWorld);
    this.#light.updateMatrixWorld();
    return without(left, draw);
  }

  /** Where a point of the picture is on the canvas: CSS pixels and depth; null behind the eye. */
  project(point) {
    const at = point.clone().project(this.camera);
    if (!(at.z > -1 && at.z < 1)) return null;
    const { width, height } = this.viewport;
    return { x: (at.x + 1) * width / 2, y: (1 - at.y) * height / 2, depth: at.z };
  }

  /** How many geometries, textures and programs the graphics card holds. */
  get held() {
    const { memory, programs } = this.#renderer.info;
    return { ...memory, programs: programs?.length ?? 0 };
  }

  /** The picture as a PNG blob. */
  async picture() {
    this.draw(performance.now());
    return new Promise((done) => this.canvas.toBlob(done, "image/png"));
  }

  /** Draw at once; `now` [ms] is handed to those who asked for it. */
  draw(now) {
    this.#scheduled = false;
    for (const act of this.#before) act(now);
    this.#light.position.copy(this.camera.position);
    this.#renderer.render(this.scene, this.camera);
    for (const act of this.#after) act(now);
  }

  /** The browser may take the context, as when a graphics driver restarts, and give it back. */
  #listenForLoss() {
    this.canvas.addEventListener("webglcontextlost", () => this.#tellLoss(true));
    this.canvas.addEventListener("webglcontextrestored", () => {
      this.#tellLoss(false);
      this.requestDraw();
    });
  }

  #tellLoss(isLost) {
    for (const act of this.lost) act(isLost);
  }

  #resize() {
    const { clientWidth: width, clientHeight: height } = this.canvas.parentElement;
    if (!width || !height) return;
    Object.assign(this.viewport, { width, height });
    const ratio = this.isSoftware ? 1 : Math.min(devicePixelRatio, MOST_PIXELS_PER_CSS);
    this.#renderer.setPixelRatio(ratio);
    this.#renderer.setSize(width, height, false);
    for (const act of this.resized) act(width, height);
    this.draw(performance.now()); // resizing clears the canvas
  }

  /** Called with width and height [CSS pixels] when the canvas has another size. */
  resized = [];
  /** Called with true when the browser has taken the picture, with false when it is back. */
  lost = [];
  /** Called with the colours when the scheme changes. */
  recolored = [];

  #takeColors(colors) {
    this.colors = colors;
    this.scene.background = new Color(colors.ground);
    this.grid.setColors(colors);
    for (const act of this.recolored) act(colors);
    this.requestDraw();
  }
}

/**
 * Resolves when the browser has loaded its graphics driver. The page's first context would wait for
 * that, and block the page: for a second where the processor draws.
 */
export function graphicsLoaded() {
  return new Promise((resolve) => {
    const worker = new Worker(new URL("./warm_up.js", import.meta.url));
    worker.onmessage = worker.onerror = () => { // an error: this browser draws on the page only
      worker.terminate();
      resolve();
    };
  });
}

/** A context without smoothed edges; to make a second one takes a processor a tenth of a second. */
function plainContext(canvas) {
  const options = { ...POWER, alpha: false, antialias: false, stencil: false };
  const context = canvas.getContext("webgl2", options);
  if (!context) throw new Error("This browser cannot draw in 3D: WebGL 2 is off or missing.");
  return context;
}

/** What draws, as the browser names it. */
function rendererName(context) {
  const info = context.getExtension("WEBGL_debug_renderer_info");
  return String(context.getParameter(info ? info.UNMASKED_RENDERER_WEBGL : context.RENDERER));
}

/** The same canvas, ready for another context. */
function withoutContext(canvas, context) {
  const fresh = canvas.cloneNode();
  canvas.replaceWith(fresh);
  context.getExtension("WEBGL_lose_context")?.loseContext();
  return fresh;
}
