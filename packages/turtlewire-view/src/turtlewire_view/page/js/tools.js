// Tools on the picture: measure, publish a point, a pose estimate or a goal, as RViz has them.

import { byId, make } from "../kit/dom.js";
import { Group, Plane, Quaternion, Raycaster, Vector2, Vector3 } from "three";
import { clear } from "./displays/parts/common.js";
import { makeRibbons } from "./displays/parts/ribbons.js";
import { makeArrows, makeBody } from "./displays/parts/solids.js";

const TOOLS = [
  {
    name: "measure", label: "Measure", key: "m",
    help: "Click two points to measure the distance between them.",
  },
  {
    name: "point", label: "Point", key: "c",
    help: "Click a point to publish it on /clicked_point.",
  },
  {
    name: "pose_estimate", label: "Pose", key: "p", drags: true,
    help: "Drag from the robot's position in the direction of its heading; publishes "
      + "/initialpose.",
  },
  {
    name: "goal", label: "Goal", key: "g", drags: true,
    help: "Drag from the goal in the direction of the heading there; publishes /goal_pose.",
  },
];
/** The tools that need a source one can publish to. */
const PUBLISH = new Set(["point", "pose_estimate", "goal"]);
const COLORS = { goal: [255, 25, 200, 255], pose_estimate: [25, 200, 60, 255] };
const MEASURE_COLOR = [255, 140, 0, 255];
const NEAREST_DRAG = 0.02; // of the picture's height: a shorter one is no direction

export class Tools {
  /** Name of the tool in use, or "". */
  active = "";
  /** Key to action. */
  keys = {};
  #stage;
  #frames;
  #send;
  #say;
  #buttons = new Map();
  #mark = new Group();
  #start = null; // Vector3 in the picture
  #pointer = null;
  #refusal = "";

  /** `say(text, passes)` shows a message, briefly if `passes` is true; "" removes it. */
  constructor(stage, frames, send, say) {
    this.#stage = stage;
    this.#frames = frames;
    this.#send = send;
    this.#say = say;
    stage.view.scene.add(this.#mark);
    for (const tool of TOOLS) this.#addButton(tool);
    byId("tools").hidden = false;
    const { canvas } = stage.view;
    // Before the camera's controls and displays: with a tool in hand the pointer does nothing else.
    const first = { capture: true };
    const { parentElement: around } = canvas;
    around.addEventListener("pointerdown", (event) => this.#down(event), first);
    around.addEventListener("pointermove", (event) => this.#move(event), first);
    around.addEventListener("pointerup", (event) => this.#up(event), first);
    around.addEventListener("pointercancel", () => this.choose(""), first);
  }

  /** Take a tool in hand; "" or the one in use puts it away. */
  choose(name) {
    const refused = this.#refusal && PUBLISH.has(name);
    if (refused) name = "";
    this.active = name === this.active ? "" : name;
    this.#start = this.#pointer = null;
    for (const [each, button] of this.#buttons) {
      button.setAttribute("aria-pressed", String(each === this.active));
    }
    this.#stage.view.canvas.style.cursor = this.active ? "crosshair" : "";
    this.#clear();
    this.#say(this.#tool()?.help ?? "");
    if (refused) this.#say(this.#refusal, true);
  }

  /** From now on tools that publish only say why not; "" lets them work. */
  refuse(reason) {
    this.#refusal = reason;
    for (const tool of TOOLS.filter(({ name }) => PUBLISH.has(name))) {
      const button = this.#buttons.get(tool.name);
      button.setAttribute("aria-disabled", String(reason !== ""));
      button.title = reason || titleOf(tool);
    }
    if (reason && PUBLISH.has(this.active)) this.choose("");
  }

  #tool() {
    return TOOLS.find(({ name }) => name === this.active);
  }

  #addButton(tool) {
    const { name, label, key } = tool;
    const button = make("button", { type: "button", textContent: label, title: titleOf(tool) });
    button.setAttribute("aria-pressed", "false");
    button.dataset.tool = name;
    button.onclick = () => this.choose(name);
    this.keys[key] = () => this.choose(name);
    this.#buttons.set(name, button);
    byId("tools").append(button);
  }

  #down(event) {
    if (!this.active || event.target !== this.#stage.view.canvas) return;
    event.stopImmediatePropagation();
    if (!event.isPrimary || event.button !== 0) return;
    const at = this.#place(event);
    if (!at) {
      this.#say("There is no ground at this point: move the camera higher.");
      return;
    }
    if (this.#tool().drags) {
      this.#start = at;
      this.#pointer = event.pointerId;
      event.target.setPointerCapture(event.pointerId);
      this.#drawPose(at, 0);
    } else if (this.active === "measure") this.#measure(at);
    else {
      this.#publish(at, 0);
    }
  }

  #move(event) {
    if (!this.active || event.target !== this.#stage.view.canvas) return;
    event.stopImmediatePropagation();
    if (this.#pointer === event.pointerId) this.#drawPose(this.#start, this.#yaw(event));
    else if (this.active === "measure" && this.#start) this.#drawLine(this.#place(event));
  }

  #up(event) {
    if (!this.active || event.target !== this.#stage.view.canvas) return;
    event.stopImmediatePropagation();
    if (this.#pointer === event.pointerId) this.#publish(this.#start, this.#yaw(event));
  }

  /** Tell the server; what lies in the picture is less the origin, which it adds. */
  #publish(at, yaw) {
    this.#send({ type: "publish", tool: this.active, position: at.toArray(), yaw });
    this.choose("");
  }

  #measure(at) {
    if (!this.#start) {
      this.#start = at;
      return;
    }
    const from = this.#start;
    this.#drawLine(at);
    const by = at.clone().sub(from);
    const [x, y, z] = by.toArray().map((value) => value.toFixed(3));
    this.#say(`${by.length().toFixed(3)} m (x ${x}, y ${y}, z ${z})`);
    this.#start = null;
  }

  /** The point of the scene, or of the ground, under the pointer; null in the sky. */
  #place(event, onGround = this.#tool().drags) {
    const { camera, viewport, displays } = this.#stage.view;
    const ray = new Raycaster();
    const { offsetX: x, offsetY: y } = event;
    const at = new Vector2((2 * x) / viewport.width - 1, 1 - (2 * y) / viewport.height);
    camera.updateMatrixWorld();
    ray.setFromCamera(at, camera);
    ray.params.Points.threshold = 4 / this.#stage.cameras.pixelsPerMetre;
    const hits = onGround ? [] : ray.intersectObject(displays);
    const hit = hits.find(({ object }) => isSeen(object));
    return hit?.point ?? ray.ray.intersectPlane(this.#ground(), new Vector3());
  }

  #ground() {
    return new Plane(new Vector3(0, 0, 1), this.#frames.origin[2]);
  }

  #yaw(event) {
    const to = this.#place(event);
    if (!to) return 0;
    const by = to.sub(this.#start);
    const least = (NEAREST_DRAG * this.#stage.view.viewport.height)
      / this.#stage.cameras.pixelsPerMetre;
    return by.length() < least ? 0 : Math.atan2(by.y, by.x);
  }

  #drawPose(at, yaw) {
    this.#clear();
    const length = 90 / this.#stage.cameras.pixelsPerMetre;
    const turn = new Quaternion().setFromAxisAngle(new Vector3(0, 0, 1), yaw);
    const shape = { shaft: [0.7 * length, 0.1 * length], head: [0.3 * length, 0.25 * length] };
    this.#mark.add(makeArrows([{ at, turn, ...shape }], COLORS[this.active]));
    this.#stage.view.requestDraw();
  }

  #drawLine(to) {
    this.#clear();
    if (!to) return;
    const from = this.#start;
    const points = new Float32Array([...from.toArray(), ...to.toArray()]);
    this.#mark.add(makeRibbons(points, MEASURE_COLOR, { least: 3 }));
    const size = 10 / this.#stage.cameras.pixelsPerMetre;
    for (const end of [from, to]) {
      const ball = makeBody("sphere", [size, size, size], MEASURE_COLOR);
      ball.position.copy(end);
      this.#mark.add(ball);
    }
    this.#stage.view.requestDraw();
  }

  #clear() {
    clear(this.#mark);
    this.#stage.view.requestDraw();
  }
}

function isSeen(object) {
  for (let at = object; at; at = at.parent) if (!at.visible) return false;
  return true;
}

function titleOf({ help, key }) {
  return `${help} (${key.toUpperCase()})`;
}
