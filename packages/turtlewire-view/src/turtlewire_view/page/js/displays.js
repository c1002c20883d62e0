// Displays: modules below displays/, each loaded when the first of its displays is added.
// The parts of a display, each at a pose or below a frame that moves.

import * as three from "three";
import { Group } from "three";

import { bytesOf } from "./colors.js";

export class DisplayParts {
  object = new Group();
  #parts = new Map(); // name to group

  /** The group of a part; a new one is empty. */
  group(part) {
    let group = this.#parts.get(part);
    if (!group) {
      group = new Group();
      this.#parts.set(part, group);
      this.object.add(group);
    }
    return group;
  }

  /** Place a part at `pose` (null: unknown, not shown), or below `frame` from now on. */
  place(part, { pose, frame }) {
    const group = this.#parts.get(part);
    if (!group) return;
    group.userData.frame = frame ?? null;
    if (pose !== undefined) setPose(group, pose);
  }

  /** Parts below frames move with them. */
  follow(frames) {
    for (const group of this.#parts.values()) {
      if (group.userData.frame) setPose(group, frames.poseOf(group.userData.frame));
    }
  }

  remove(part) {
    const group = this.#parts.get(part);
    if (!group) return;
    this.#parts.delete(part);
    this.object.remove(group);
    disposeBelow(group);
  }

  dispose() {
    for (const part of [...this.#parts.keys()]) this.remove(part);
    this.object.removeFromParent();
  }
}

function setPose(group, pose) {
  group.visible = pose !== null && pose.every(Number.isFinite);
  if (!group.visible) return;
  group.position.fromArray(pose);
  group.quaternion.set(pose[3], pose[4], pose[5], pose[6]);
}

/** Free what the graphics card holds for everything below an object. */
export function disposeBelow(object) {
  object.traverse((each) => {
    const { geometry, material } = each;
    if (each.isInstancedMesh) each.dispose();
    geometry?.dispose();
    for (const each of [material].flat()) {
      if (!each) continue;
      for (const value of Object.values(each)) if (value?.isTexture) value.dispose();
      each.dispose();
    }
  });
}

/** Module and class of kinds that share a module; others have a module of their own. */
const SHARED = {
  camera_info: ["shapes", "CameraInfo"],
  depth_cloud: ["point_cloud", "DepthCloud"],
  grid_cells: ["shapes", "GridCells"],
  laser_scan: ["point_cloud", "PointCloud"],
  measurement: ["shapes", "Measurement"],
  odometry: ["poses", "Pose"],
  path: ["poses", "Path"],
  point: ["shapes", "Point"],
  point_cloud: ["point_cloud", "PointCloud"],
  polygon: ["shapes", "Polygon"],
  pose: ["poses", "Pose"],
  pose_array: ["poses", "PoseArray"],
  range: ["shapes", "Range"],
};

let table = null; // the options of all kinds; the server checks choices by the same table

export class Displays {
  /** Called when a display has its first content, or more to look at. */
  onGrowth = () => {};
  #view;
  #frames;
  #send;
  #onChange;
  #entries = new Map(); // id to entry

  /** `onChange()`: the list or a status has changed. `view` is null without WebGL. */
  constructor(view, frames, send, onChange) {
    this.#view = view;
    this.#frames = frames;
    this.#send = send;
    this.#onChange = onChange;
    view?.recolored.push((colors) => {
      for (const { display } of this.#entries.values()) display?.schemeChanged?.(colors);
    });
  }

  /** All displays: { id, kind, topic, options, schema, items, visible, level, text }. */
  get list() {
    return [...this.#entries.values()];
  }

  /** Add a display; `id` of one that a loaded view names. */
  async add(wanted) {
    const { kind, topic, options = {}, visible = true } = wanted;
    const id = wanted.id ?? crypto.randomUUID?.() ?? `${kind}-${Date.now()}`;
    const { place } = wanted; // in the loaded file
    const entry = { id, kind, topic, place, options, visible, schema: [], level: "ok", text: "" };
    this.#entries.set(id, entry);
    this.#onChange();
    try {
      const [file, name] = SHARED[kind] ?? [kind, "default"];
      const [module, schema] = await Promise.all([
        import(`./displays/${file}.js`), optionsOf(kind),
      ]);
      if (!this.#entries.has(id)) return;
      entry.schema = schema;
      entry.options = { ...defaults(entry.schema), ...options };
      if (this.#view) this.#draw(entry, module[name]);
    } catch (error) {
      entry.level = "error";
      entry.text = `This page cannot draw "${kind}": ${error.message}`;
      this.#onChange();
      return;
    }
    if (!visible) this.setVisible(id, false);
    this.#announce(entry);
    this.#onChange();
  }

  remove(id) {
    const entry = this.#entries.get(id);
    if (!entry) return;
    this.#entries.delete(id);
    entry.display?.dispose?.();
    entry.parts?.dispose();
    this.#send({ type: "remove", id });
    this.#view?.requestDraw();
    this.#onChange();
  }

  setVisible(id, visible) {
    const entry = this.#entries.get(id);
    entry.visible = visible;
    if (entry.parts) entry.parts.object.visible = visible;
    entry.display?.setVisible?.(visible);
    this.#view?.requestDraw();
    this.#onChange();
  }

  setOption(id, name, value) {
    const entry = this.#entries.get(id);
    entry.options = { ...entry.options, [name]: value };
    entry.display?.setOptions?.(entry.options);
    this.#send({ type: "options", id, options: forServer(entry) });
    this.#view?.requestDraw();
  }

  /** Show another topic with the same options. */
  setTopic(id, topic) {
    const entry = this.#entries.get(id);
    this.#send({ type: "remove", id });
    Object.assign(entry, { topic, level: "ok", text: "", problem: "" });
    this.#begin(entry);
    this.#view?.requestDraw();
    this.#onChange();
  }

  /** A new connection knows no display. */
  announceAll() {
    for (const entry of this.#entries.values()) this.#begin(entry);
  }

  /** A packet `display`, `pose`, `removed` or `status` with an id. */
  take(packet) {
    const entry = this.#entries.get(packet.id);
    if (!entry) return;
    if (packet.type === "status") {
      Object.assign(entry, { level: packet.level, text: packet.text });
      this.#onChange();
    } else if (entry.parts) this.#takeGeometry(entry, packet);
    this.#view?.requestDraw();
  }

  /** After each packet of poses. */
  follow() {
    for (const { parts, display } of this.#entries.values()) {
      parts?.follow(this.#frames);
      display?.update?.(this.#frames);
    }
  }

  #takeGeometry(entry, packet) {
    const { part = "", arrays, shapes } = packet;
    if (packet.type === "removed") {
      entry.display.removed?.(part);
      entry.parts.remove(part);
      entry.partNames.delete(part);
    } else {
      if (packet.type === "display") {
        entry.partNames.add(part);
        entry.display.show(entry.parts.group(part), packet, arrays, shapes);
      }
      entry.parts.place(part, packet);
      if (packet.frame) entry.parts.follow(this.#frames);
      if (packet.type === "display" && !entry.isSeen) {
        entry.isSeen = true;
        this.onGrowth();
      }
    }
  }

  #begin(entry) {
    for (const part of entry.partNames ?? []) {
      entry.display.removed?.(part);
      entry.parts.remove(part);
    }
    entry.partNames?.clear();
    this.#announce(entry);
  }

  #draw(entry, Kind) {
    entry.parts = new DisplayParts();
    entry.partNames = new Set();
    entry.display = new Kind(this.#context(entry), entry.options);
    this.#view.displays.add(entry.parts.object);
  }

  #report(entry, text) {
    if (entry.problem === text) return;
    entry.problem = text;
    this.#onChange();
  }

  #context(entry) {
    const view = this.#view;
    return {
      three,
      scene: view.scene,
      viewport: view.viewport,
      get camera() { return view.camera; },
      get colors() { return view.colors; },
      id: entry.id,
      get topic() { return entry.topic; },
      hide: () => this.setVisible(entry.id, false),
      requestDraw: () => view.requestDraw(),
      canvas: view.canvas,
      beforeDraw: (act) => view.beforeDraw(act),
      afterDraw: (act) => view.afterDraw(act),
      pictureFrom: (...wanted) => view.pictureFrom(...wanted),
      /** Say that there is more to look at, as a mesh that has been loaded. */
      grown: () => this.onGrowth(),
      now: () => this.#frames.stamp,
      poseOf: (name) => this.#frames.poseOf(name),
      send: (command) => this.#send(command),
      /** Say what the page itself cannot draw; "" when it can again. */
      report: (text) => this.#report(entry, text),
      /** Name what an option of type "items" lets the user choose from. */
      offerItems: (option, names) => {
        entry.items = { ...entry.items, [option]: names };
        this.#onChange();
      },
    };
  }

  #announce(entry) {
    const { id, kind, topic } = entry;
    this.#send({ type: "add", id, kind, topic, options: forServer(entry) });
  }
}

function defaults(schema) {
  return Object.fromEntries(schema.map(({ name, value }) => [name, value]));
}

/** Colours travel as three numbers. */
function forServer({ schema, options }) {
  const colors = new Set(schema.filter(({ type }) => type === "color").map(({ name }) => name));
  return Object.fromEntries(Object.entries(options).map(([name, value]) => {
    return [name, colors.has(name) ? bytesOf(value) : value];
  }));
}

/** The options of a kind: { name, label, type, value, min, max, step, choices }. */
async function optionsOf(kind) {
  table ??= loadTable();
  table.catch(() => { table = null; }); // it may be there the next time
  const lists = await table;
  const listed = (name) => lists[name].flatMap((each) => {
    return typeof each === "string" ? listed(each) : [each];
  });
  return listed(kind);
}

async function loadTable() {
  const answer = await fetch(new URL("./displays/options.json", import.meta.url));
  if (!answer.ok) throw new Error(`the table of options cannot be loaded (${answer.status})`);
  return answer.json();
}

/** Robots are shown without a request, as soon as a node publishes a description. */
export class Robots {
  /** Whether to add displays; not when a loaded view names those that are wanted. */
  isOn = true;
  #displays;
  #known = new Set(); // topics; a display that the user removed does not come back

  constructor(displays) {
    this.#displays = displays;
  }

  /** Take the server's topics, and show each robot that is new. */
  take(topics) {
    if (!this.isOn) return;
    const described = topics.filter(({ kind, publishers }) => kind === "robot_model" && publishers);
    for (const { name, kind } of described.filter(({ name }) => !this.#known.has(name))) {
      this.#known.add(name);
      const isShown = this.#displays.list.some((each) => each.kind === kind && each.topic === name);
      if (!isShown) this.#displays.add({ kind, topic: name });
    }
  }
}
