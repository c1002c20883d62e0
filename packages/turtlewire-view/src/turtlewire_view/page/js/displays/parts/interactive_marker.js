// One interactive marker: its controls, title and axes at its pose.

import { Group, Matrix4, Quaternion, Ray, Vector3 } from "three";

import { bytesOf, setPose } from "./common.js";
import { ControlDrag, makeHandle } from "./controls.js";
import { addMarker } from "./marker_object.js";
import { makeRibbons } from "./ribbons.js";
import { makeAxes } from "./solids.js";
import { makeText } from "./text.js";

const [TITLE_HEIGHT, TITLE_SIZE] = [1.4, 0.15]; // of the marker's size, as in RViz
const AID_COLOR = [160, 160, 160, 255];
const AID_LENGTH = 20; // of the marker's size
const X = new Vector3(1, 0, 0);
const GLOW = 0.3;
/** Modes of controls that a drag moves. */
const DRAGGED = new Set([
  "move_axis", "move_plane", "rotate_axis", "move_rotate", "move_3d", "rotate_3d",
  "move_rotate_3d",
]);

export class InteractiveMarker {
  name;
  revision;
  menu;
  group;
  #view;
  #controls = []; // { control, node, handles, markers }
  #extras = new Group(); // title and axes
  #position = new Vector3();
  #turn = new Quaternion();
  #wanted = null; // pose that the server sent during a drag
  #drag = null;
  #aid = null;
  #glowing = null;

  /** Below `group`, which is at the frame of the marker. */
  constructor(view, group, header, arrays, options) {
    Object.assign(this, {
      name: header.part, revision: header.revision, menu: header.menu, group,
    });
    this.#view = view;
    for (const control of header.controls) this.#addControl(control, header, arrays, options);
    this.#addExtras(header, options);
    this.setPose(header.pose);
  }

  get isDragged() {
    return this.#drag !== null;
  }

  /** [x, y, z, qx, qy, qz, qw] in the marker's frame. */
  get pose() {
    return [...this.#position.toArray(), ...this.#turn.toArray()];
  }

  /** What the pointer can hit. */
  get objects() {
    return this.#controls.map(({ node }) => node);
  }

  /** The server's pose; during a drag it has to wait. */
  setPose(pose) {
    if (this.#drag) {
      this.#wanted = pose;
      return;
    }
    this.#position.fromArray(pose);
    this.#turn.fromArray(pose, 3);
    this.#place();
  }

  /** The control that an object belongs to. */
  controlOf(object) {
    for (let at = object; at; at = at.parent) {
      if (at.userData.control) return at.userData.control;
    }
    return null;
  }

  /** Controls that face the eye turn; before each picture. */
  face(camera) {
    if (!this.#controls.some(({ control }) => control.orientation === "view_facing")) return;
    const { facing, up } = this.#eye(camera);
    for (const entry of this.#controls) {
      if (entry.control.orientation === "view_facing") this.#faceEye(entry, facing, up);
    }
  }

  /** Begin a drag of a control; returns whether it can be dragged. */
  press(control, pointer, camera) {
    if (!DRAGGED.has(control.mode)) return false;
    const entry = this.#controls.find((each) => each.control === control);
    const turn = entry.node.quaternion.clone().multiply(new Quaternion().fromArray(control.turn));
    const axis = X.clone().applyQuaternion(turn).normalize();
    const start = { axis, ...this.#eye(camera), position: this.#position, turn: this.#turn };
    this.#drag = new ControlDrag(control.mode, start, this.local(pointer));
    return true;
  }

  /** Move with the pointer. */
  drag(pointer) {
    const { position, turn } = this.#drag.to(this.local(pointer));
    if (![...position.toArray(), ...turn.toArray()].every(Number.isFinite)) return;
    this.#position.copy(position);
    this.#turn.copy(turn);
    this.#place();
  }

  release() {
    this.#drag = null;
    this.showAid(null);
    const pose = this.#wanted;
    this.#wanted = null;
    if (pose) this.setPose(pose);
  }

  /** A pointer in the marker's frame. */
  local(pointer) {
    this.group.updateWorldMatrix(true, false);
    const inverse = new Matrix4().copy(this.group.matrixWorld).invert();
    const ray = new Ray().copy(pointer.ray).applyMatrix4(inverse);
    return { ...pointer, ray, point: pointer.point?.clone().applyMatrix4(inverse) ?? null };
  }

  /** Light up a control, or none. */
  glow(control) {
    if (this.#glowing === control) return;
    for (const entry of this.#controls) {
      if (entry.control === this.#glowing) light(entry.node, 0);
      if (entry.control === control) light(entry.node, GLOW);
    }
    this.#glowing = control;
  }

  /** The line that a control moves along or turns about; null for none. */
  showAid(control) {
    if (this.#aid) {
      this.#aid.removeFromParent();
      this.#aid.geometry.dispose();
      this.#aid.material.dispose();
      this.#aid = null;
    }
    if (control?.mode !== "move_axis" && control?.mode !== "rotate_axis") return;
    const entry = this.#controls.find((each) => each.control === control);
    const line = new Float32Array([-AID_LENGTH, 0, 0, AID_LENGTH, 0, 0]);
    this.#aid = makeRibbons(line, AID_COLOR, {});
    this.#aid.quaternion.fromArray(control.turn);
    entry.handles.add(this.#aid);
  }

  #addControl(control, { scale }, arrays, options) {
    const node = new Group(); // at the marker, turned as the control is
    const handles = new Group();
    const markers = new Group();
    handles.scale.setScalar(scale);
    node.userData.control = control;
    for (const marker of control.markers) {
      const holder = setPose(new Group(), marker.pose);
      markers.add(holder);
      addMarker(holder, marker, arrays, this.#view, `marker ${this.name}`);
    }
    const ink = bytesOf(this.#view.colors.ink);
    const handle = control.markers.length ? null : makeHandle(control, options.transparency, ink);
    if (handle) handles.add(handle);
    node.add(handles, markers);
    this.group.add(node);
    this.#controls.push({ control, node, handles, markers });
  }

  #addExtras({ description, scale }, options) {
    const { show_descriptions: hasTitle, show_axes: hasAxes } = options;
    if (description && hasTitle) {
      const title = makeText(description, TITLE_SIZE * scale, bytesOf(this.#view.colors.ink));
      title.position.z = TITLE_HEIGHT * scale;
      this.#extras.add(title);
    }
    if (hasAxes) {
      const place = { at: new Vector3(), turn: new Quaternion() };
      const axes = makeAxes([place], scale, 0.05 * scale);
      axes.userData.isTurned = true;
      this.#extras.add(axes);
    }
    this.group.add(this.#extras);
  }

  #place() {
    this.#extras.position.copy(this.#position);
    for (const part of this.#extras.children) {
      if (part.userData.isTurned) part.quaternion.copy(this.#turn);
    }
    for (const { control, node, markers } of this.#controls) {
      node.position.copy(this.#position);
      if (control.orientation === "inherit") node.quaternion.copy(this.#turn);
      if (control.independent) this.#keepTurned(node, markers);
    }
  }

  /** Markers that are turned as the marker is, whichever way their control faces. */
  #keepTurned(node, markers) {
    markers.quaternion.copy(node.quaternion).invert().multiply(this.#turn);
  }

  /** The direction to the eye and up on the screen, in the marker's frame. */
  #eye(camera) {
    this.group.updateWorldMatrix(true, false);
    const back = new Quaternion().setFromRotationMatrix(
      new Matrix4().extractRotation(this.group.matrixWorld),
    ).invert();
    const facing = new Vector3().setFromMatrixColumn(camera.matrixWorld, 2).applyQuaternion(back);
    const up = new Vector3().setFromMatrixColumn(camera.matrixWorld, 1).applyQuaternion(back);
    return { facing: facing.normalize(), up: up.normalize() };
  }

  /** The control's x axis goes to the eye, and its z axis up. */
  #faceEye({ control, node, markers }, facing, up) {
    const left = up.clone().cross(facing);
    const axes = new Matrix4().makeBasis(facing, left, up);
    const own = new Quaternion().fromArray(control.turn).invert();
    node.quaternion.setFromRotationMatrix(axes).multiply(own);
    if (control.independent) this.#keepTurned(node, markers);
  }
}

function light(object, glow) {
  object.traverse(({ material }) => material?.emissive?.setScalar(glow));
}
