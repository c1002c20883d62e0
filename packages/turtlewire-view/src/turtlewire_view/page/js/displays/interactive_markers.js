// InteractiveMarkers: markers of a server that the user drags and clicks, with menus.
// The menu of an interactive marker, at the pointer.

import { make } from "../../kit/dom.js";
import { clear } from "./parts/common.js";
import { ControlPointer } from "./parts/controls.js";
import { InteractiveMarker } from "./parts/interactive_marker.js";

let open = null;

/**
 * Show a menu at [x, y] of the viewport. `entries`: { id, parent, title, runs }; a parent of 0 is
 * the first level. `choose(id)` is called with the entry that the user selects.
 */
function openMenu(entries, [x, y], choose) {
  closeMenu();
  const around = document.getElementById("viewport");
  const menu = make("div", { className: "marker-menu" });
  menu.setAttribute("role", "menu");
  menu.append(...level(entries, 0, new Set(), (id) => {
    closeMenu();
    choose(id);
  }));
  around.append(menu);
  const { clientWidth, clientHeight } = around;
  menu.style.left = `${Math.max(0, Math.min(x, clientWidth - menu.offsetWidth))}px`;
  menu.style.top = `${Math.max(0, Math.min(y, clientHeight - menu.offsetHeight))}px`;
  const leave = (event) => {
    if (event.type === "keydown" ? event.key === "Escape" : !menu.contains(event.target)) {
      event.stopPropagation();
      closeMenu();
    }
  };
  addEventListener("pointerdown", leave, true);
  addEventListener("keydown", leave, true);
  open = { menu, leave };
  menu.querySelector("button:not(:disabled), summary")?.focus();
}

function closeMenu() {
  if (!open) return;
  removeEventListener("pointerdown", open.leave, true);
  removeEventListener("keydown", open.leave, true);
  open.menu.remove();
  open = null;
}

/** The entries below a parent; `above` are the parents of these, for a menu may be a circle. */
function level(entries, parent, above, choose) {
  return entries.filter((entry) => entry.parent === parent && !above.has(entry.id)).map((entry) => {
    const inner = level(entries, entry.id, new Set([...above, entry.id]), choose);
    if (inner.length) {
      return make("details", {}, make("summary", { textContent: entry.title }), ...inner);
    }
    const button = make("button", { type: "button", textContent: entry.title });
    button.setAttribute("role", "menuitem");
    button.onclick = () => choose(entry.id);
    if (entry.runs) {
      button.disabled = true;
      button.title = `This page starts no programs: ${entry.runs}`;
    }
    return button;
  });
}

/** Numbers of event types, as in InteractiveMarkerFeedback. */
const EVENT = {
  keepAlive: 0, poseUpdate: 1, menuSelect: 2, buttonClick: 3, mouseDown: 4, mouseUp: 5,
};
const KEEP_ALIVE_MS = 250;
/** Servers keep one message: one that comes at once after the last pose could replace it. */
const GAP_MS = 50;

export default class InteractiveMarkers {
  #view;
  #options;
  #markers = new Map(); // part to { marker, header, arrays }
  #pointer;
  #held = null; // { marker, control, isMoved, timer }
  #hovered = null;
  #ending = null; // tells the end of a drag
  #ends;

  constructor(view, options) {
    this.#view = view;
    this.#options = options;
    this.#pointer = new ControlPointer(view, () => this.#objects(), {
      hover: (object) => this.#hover(object),
      press: (object, pointer) => this.#press(object, pointer),
      drag: (pointer) => this.#drag(pointer),
      release: (pointer, object) => this.#release(pointer, object),
      menu: (object, pointer) => this.#openMenu(...this.#find(object), pointer),
    });
    this.#ends = view.beforeDraw(() => this.#prepare());
  }

  show(group, header, arrays) {
    const known = this.#markers.get(header.part);
    if (known?.marker.revision === header.revision && known.marker.group === group) {
      Object.assign(known, { header, arrays });
      known.marker.setPose(header.pose);
    } else this.#make(group, header, arrays);
  }

  removed(part) {
    const known = this.#markers.get(part);
    if (this.#held?.marker === known?.marker) this.#letGo();
    this.#markers.delete(part);
  }

  setOptions(options) {
    this.#options = options;
    for (const { marker, header, arrays } of [...this.#markers.values()]) {
      this.#make(marker.group, { ...header, pose: marker.pose }, arrays);
    }
  }

  /** Texts have the colour of the page. */
  schemeChanged() {
    this.setOptions(this.#options);
  }

  dispose() {
    this.#letGo();
    clearTimeout(this.#ending);
    closeMenu();
    this.#pointer.dispose();
    this.#ends();
  }

  #make(group, header, arrays) {
    this.removed(header.part);
    clear(group);
    const marker = new InteractiveMarker(this.#view, group, header, arrays, this.#options);
    this.#markers.set(header.part, { marker, header, arrays });
    this.#view.grown?.();
  }

  #objects() {
    return [...this.#markers.values()].flatMap(({ marker }) => marker.objects);
  }

  /** Marker and control of an object; two nulls if it belongs to none. */
  #find(object) {
    for (const { marker } of this.#markers.values()) {
      const control = object && marker.controlOf(object);
      if (control && marker.objects.some((node) => node.userData.control === control)) {
        return [marker, control];
      }
    }
    return [null, null];
  }

  /** Once for each picture: the controls that face the eye, and the pose of what is dragged. */
  #prepare() {
    for (const { marker } of this.#markers.values()) marker.face(this.#view.camera);
    if (!this.#held?.isMoved) return;
    this.#held.isMoved = false;
    this.#tell(EVENT.poseUpdate);
  }

  #hover(object) {
    const [marker, control] = this.#find(object);
    if (this.#hovered === control) return;
    this.#hovered = control;
    for (const each of this.#markers.values()) {
      each.marker.glow(each.marker === marker ? control : null);
    }
    if (!control) this.#view.canvas.style.cursor = "";
    this.#view.requestDraw();
  }

  #press(object, pointer) {
    const [marker, control] = this.#find(object);
    if (!marker) return;
    closeMenu();
    const isDragged = marker.press(control, pointer, this.#view.camera);
    this.#held = { marker, control, isDragged, isMoved: false, timer: null };
    if (isDragged && this.#options.show_visual_aids) marker.showAid(control);
    this.#tell(EVENT.mouseDown, pointer);
    this.#keepAlive();
    this.#view.requestDraw();
  }

  #drag(pointer) {
    if (!this.#held?.isDragged) return;
    this.#held.marker.drag(pointer);
    this.#held.isMoved = true;
    this.#view.requestDraw();
  }

  #release(pointer, object) {
    if (!this.#held) return;
    const { marker, control, isDragged, isMoved } = this.#held;
    if (isMoved) this.#tell(EVENT.poseUpdate);
    const isClick = this.#find(object)[1] === control;
    const end = [EVENT.mouseUp];
    if (isClick && control.mode === "button") end.push(EVENT.buttonClick);
    const { pose } = marker;
    const tellEnd = () => {
      for (const event of end) this.#send(marker, control, event, pointer, { pose });
    };
    clearTimeout(this.#ending);
    if (isDragged) this.#ending = setTimeout(tellEnd, GAP_MS);
    else tellEnd();
    this.#letGo();
    if (isClick && control.mode === "menu") this.#openMenu(marker, control, pointer);
    this.#view.requestDraw();
  }

  #letGo() {
    clearTimeout(this.#held?.timer);
    this.#held?.marker.release();
    this.#held = null;
  }

  /** While a control is held, send an event at least every quarter of a second, as RViz does. */
  #keepAlive() {
    const held = this.#held;
    clearTimeout(held.timer);
    held.timer = setTimeout(() => {
      if (this.#held === held) this.#tell(EVENT.keepAlive);
    }, KEEP_ALIVE_MS);
  }

  #openMenu(marker, control, pointer) {
    if (!marker?.menu.length) return;
    openMenu(marker.menu, [pointer.x, pointer.y], (id) => {
      this.#send(marker, control, EVENT.menuSelect, pointer, { entry: id });
    });
  }

  #tell(event, pointer = null) {
    const { marker, control } = this.#held;
    this.#send(marker, control, event, pointer);
    this.#keepAlive();
  }

  #send(marker, control, event, pointer, { entry = 0, pose = marker.pose } = {}) {
    const point = pointer?.point ? marker.local(pointer).point.toArray() : null;
    this.#view.send({
      type: "feedback", id: this.#view.id, marker: marker.name, control: control.name, event,
      pose, menu_entry: entry, mouse_point: point,
    });
  }
}
