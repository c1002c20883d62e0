// Ways to look: around a point, from above, or after a frame.

import { Box3, MOUSE, OrthographicCamera, PerspectiveCamera, TOUCH, Vector3 } from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";

const FIELD_OF_VIEW = 50; // [degrees]
const START = new Vector3(-0.3, -0.85, 0.6); // where the eye is from the middle, to be scaled
const TURN = Math.PI / 24;
const ZOOM = 0.85;
const MARGIN = 0.94; // of the picture is filled at most
const DRAG = 5; // [CSS pixels] a press that moves less is a click
const LEAST_FREE = 0.4; // of its upper half is used in any case

export class Cameras {
  /** "orbit" or "top". */
  kind = "orbit";
  /** Name of the frame that stays in place on the screen, or "". */
  followed = "";
  /** Whether the user has moved a camera. */
  isTouched = false;
  #view;
  #onChange;
  #cameras = {};
  #controls = {};
  #height = 10; // of what the camera from above sees [m]
  #former = null;
  #focus = new Vector3(); // what is looked at, from the followed frame
  #presses = new Map(); // pointer to where it was pressed

  /** `onChange()`: the user chose another frame or kind. */
  constructor(view, onChange = () => {}) {
    this.#view = view;
    this.#onChange = onChange;
    this.#add("orbit", new PerspectiveCamera(FIELD_OF_VIEW, 1, 0.01, 5000));
    this.#add("top", new OrthographicCamera(-1, 1, 1, -1, 0.1, 20_000));
    const { top } = this.#controls;
    top.enableRotate = false;
    top.mouseButtons = { LEFT: MOUSE.PAN, MIDDLE: MOUSE.DOLLY, RIGHT: MOUSE.PAN };
    top.touches = { ONE: TOUCH.PAN, TWO: TOUCH.DOLLY_PAN };
    top.screenSpacePanning = true;
    view.resized.push(() => this.#shape());
    view.canvas.addEventListener("keydown", (event) => this.#key(event));
    this.#listenForTouch(view.canvas);
    this.look(new Vector3(), 4);
    this.choose("orbit");
  }

  /** Look around a point ("orbit") or from above ("top"). */
  choose(kind) {
    const target = this.#controls[this.kind].target.clone();
    this.kind = kind;
    for (const name of ["orbit", "top"]) this.#controls[name].enabled = name === kind;
    this.#view.camera = this.#cameras[kind];
    this.#shift(target.sub(this.#controls[kind].target));
    this.#shape();
    this.#onChange();
  }

  /**
   * See everything within `radius` [m] of `middle`. The whole `box` is in the picture, and below
   * its upper `covered` pixels.
   */
  look(middle, radius, box = new Box3(), covered = 0) {
    const { orbit, top } = this.#cameras;
    const round = (0.92 * radius) / Math.sin((FIELD_OF_VIEW * Math.PI) / 360) / this.#narrow();
    const corners = cornersOf(box).map((corner) => corner.sub(middle));
    const away = Math.max(round, this.#distanceFor(corners, covered));
    for (const controls of Object.values(this.#controls)) controls.target.copy(middle);
    orbit.position.copy(START).normalize().multiplyScalar(away).add(middle);
    orbit.near = Math.max(0.001, away / 500);
    orbit.far = 200 * away;
    this.#height = (2.1 * radius) / this.#narrow();
    top.position.set(middle.x, middle.y, middle.z + 5000);
    top.zoom = 1;
    this.#shape();
    for (const controls of Object.values(this.#controls)) controls.update();
  }

  /** Keep a frame where it is on the screen, `focus` from the middle; "" ends it. */
  follow(name, focus = new Vector3()) {
    this.followed = name;
    this.#former = null;
    this.#focus = focus;
    this.#onChange();
  }

  /** Move with the followed frame; after each packet of poses. */
  take(frames) {
    const pose = this.followed && frames.poseOf(this.followed);
    if (!pose || !pose.slice(0, 3).every(Number.isFinite)) return;
    const at = new Vector3(...pose);
    const target = this.#controls[this.kind].target;
    const first = at.clone().add(this.#focus).sub(target);
    this.#shift(this.#former ? at.clone().sub(this.#former) : first);
    this.#former = at;
  }

  /** Look at another place from the same side. */
  move(by) {
    this.#shift(by);
  }

  /**
   * The current view, in the form in which it is saved: `kind`, `frame` that is followed or "",
   * `focus` in it or in the fixed frame [m], `distance` [m], `yaw` and `pitch` [rad], `scale`
   * [pixels/m].
   */
  saved(origin) {
    const { target } = this.#controls[this.kind];
    const eye = this.#cameras.orbit.position.clone().sub(this.#controls.orbit.target);
    const distance = eye.length();
    const start = this.followed ? this.#former ?? target : new Vector3(...origin).negate();
    return {
      kind: this.kind, frame: this.followed, focus: target.clone().sub(start).toArray(), distance,
      yaw: Math.atan2(eye.y, eye.x), pitch: Math.asin(eye.z / distance),
      scale: this.kind === "top" ? this.pixelsPerMetre : null,
    };
  }

  /** Look as a saved view says. */
  restore({ kind, frame, focus, distance, yaw, pitch, scale }, origin) {
    this.isTouched = true;
    const middle = new Vector3(...focus);
    if (!frame) middle.sub(new Vector3(...origin));
    const { orbit, top } = this.#controls;
    for (const { target } of [orbit, top]) target.copy(middle);
    const flat = Math.cos(pitch) * distance;
    const eye = new Vector3(Math.cos(yaw) * flat, Math.sin(yaw) * flat, Math.sin(pitch) * distance);
    this.#cameras.orbit.position.copy(middle).add(eye);
    this.#cameras.orbit.near = Math.max(0.001, distance / 500);
    this.#cameras.orbit.far = 200 * distance;
    this.#cameras.top.position.set(middle.x, middle.y, middle.z + 5000);
    this.#cameras.top.zoom = 1;
    if (scale) this.#height = this.#view.viewport.height / scale;
    this.choose(kind);
    orbit.update();
    top.update();
    this.follow(frame, frame ? new Vector3(...focus) : new Vector3());
    this.#view.requestDraw();
  }

  /** Pixels that a metre at the middle has on the screen. */
  get pixelsPerMetre() {
    const { height } = this.#view.viewport;
    const { orbit, top } = this.#cameras;
    if (this.kind === "top") return (height * top.zoom) / this.#height;
    const away = orbit.position.distanceTo(this.#controls.orbit.target);
    return height / (2 * away * Math.tan((FIELD_OF_VIEW * Math.PI) / 360));
  }

  #add(name, camera) {
    camera.up.set(0, 0, 1);
    if (name === "top") camera.up.set(0, 1, 0);
    camera.position.set(0, name === "top" ? 0 : -1, 1);
    const controls = new OrbitControls(camera, this.#view.canvas);
    controls.addEventListener("change", () => this.#view.requestDraw());
    controls.maxPolarAngle = Math.PI * 0.98;
    controls.zoomToCursor = true;
    this.#cameras[name] = camera;
    this.#controls[name] = controls;
  }

  /** The user has moved a camera by the wheel or by dragging; a click moves none. */
  #listenForTouch(canvas) {
    canvas.addEventListener("wheel", () => { this.isTouched = true; }, { passive: true });
    canvas.addEventListener("pointerdown", ({ pointerId, clientX, clientY }) => {
      this.#presses.set(pointerId, [clientX, clientY]);
    });
    canvas.addEventListener("pointermove", ({ buttons, pointerId, clientX, clientY }) => {
      const start = buttons && this.#presses.get(pointerId);
      if (start && Math.hypot(clientX - start[0], clientY - start[1]) > DRAG) this.isTouched = true;
    });
  }

  #shift(by) {
    const controls = this.#controls[this.kind];
    controls.target.add(by);
    this.#cameras[this.kind].position.add(by);
    controls.update();
    this.#view.requestDraw();
  }

  /** How far the eye must be from the middle to see `corners`, given from there [m]. */
  #distanceFor(corners, covered) {
    const { width, height } = this.#view.viewport;
    const toEye = START.clone().normalize();
    const right = new Vector3(0, 0, 1).cross(toEye).normalize();
    const upwards = toEye.clone().cross(right);
    const half = MARGIN * Math.tan((FIELD_OF_VIEW * Math.PI) / 360);
    const above = half * Math.max(LEAST_FREE, 1 - (2 * covered) / height);
    return Math.max(0, ...corners.map((corner) => {
      const [x, y] = [corner.dot(right), corner.dot(upwards)];
      const across = (Math.abs(x) * height) / (half * width);
      return corner.dot(toEye) + Math.max(across, y > 0 ? y / above : -y / half);
    }));
  }

  #shape() {
    const { width, height } = this.#view.viewport;
    const { orbit, top } = this.#cameras;
    orbit.aspect = width / height;
    top.top = this.#height / 2;
    top.bottom = -top.top;
    top.right = (top.top * width) / height;
    top.left = -top.right;
    orbit.updateProjectionMatrix();
    top.updateProjectionMatrix();
  }

  /** How much less is seen across than upwards, at most 1. */
  #narrow() {
    return Math.min(1, this.#view.viewport.width / this.#view.viewport.height);
  }

  #key(event) {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    const controls = this.#controls[this.kind];
    const pans = event.shiftKey || this.kind === "top";
    const acts = {
      ArrowLeft: () => (pans ? controls.pan(60, 0) : controls.rotateLeft(TURN)),
      ArrowRight: () => (pans ? controls.pan(-60, 0) : controls.rotateLeft(-TURN)),
      ArrowUp: () => (pans ? controls.pan(0, 60) : controls.rotateUp(TURN)),
      ArrowDown: () => (pans ? controls.pan(0, -60) : controls.rotateUp(-TURN)),
      "+": () => controls.dollyIn(ZOOM),
      "=": () => controls.dollyIn(ZOOM),
      "-": () => controls.dollyOut(ZOOM),
    };
    if (!acts[event.key]) return;
    this.isTouched = true;
    event.preventDefault();
    acts[event.key]();
  }
}

/** Return null for an empty box. */
function cornersOf(box) {
  if (box.isEmpty()) return [];
  const { min, max } = box;
  return [min.x, max.x].flatMap((x) => [min.y, max.y].flatMap((y) => {
    return [min.z, max.z].map((z) => new Vector3(x, y, z));
  }));
}
