// RobotModel: shapes of a URDF's links, each link at its frame.

import { Group, SRGBColorSpace, TextureLoader } from "three";
import { clear, free, setPose } from "./parts/common.js";
import { loadMesh, makePlaceholder, paint } from "./parts/meshes.js";
import { makeBody } from "./parts/solids.js";

const PLAIN_COLOR = [200, 10, 10, 255]; // RViz's, of what has no material
const COLLISION_COLOR = [240, 190, 60, 140];
/** Options and the parts of a link that they show. */
const PARTS = { visual: "visuals", collision: "collisions", mass: "mass", inertia: "inertia" };

export default class RobotModel {
  #view;
  #options;
  #links = []; // { name, frame, group, visuals, collisions, mass, inertia }
  #generation = 0;
  #missing = "";
  #problem = "";

  constructor(view, options) {
    this.#view = view;
    this.#options = options;
  }

  removed() {
    this.#generation += 1;
    this.#links = [];
    this.#problem = "";
    this.update();
  }

  show(group, { links }) {
    clear(group);
    this.#generation += 1;
    this.#problem = "";
    this.#links = links.map((link) => {
      const visuals = this.#shapes(link.visuals, null);
      const collisions = this.#shapes(link.collisions, COLLISION_COLOR);
      const mass = this.#shapes(link.mass, null);
      const inertia = this.#shapes(link.inertia, null);
      const holder = new Group();
      holder.add(visuals, collisions, mass, inertia);
      group.add(holder);
      const { name, frame } = link;
      return { name, frame, group: holder, visuals, collisions, mass, inertia };
    });
    this.#view.offerItems?.("links", links.map(({ name }) => name));
    this.setOptions(this.#options);
    this.update();
  }

  setOptions(options) {
    this.#options = options;
    for (const link of this.#links) {
      const { shown = true, alpha = 1 } = options.links?.[link.name] ?? {};
      for (const [option, part] of Object.entries(PARTS)) {
        link[part].visible = shown && options[option];
        fade(link[part], alpha * options.alpha);
      }
    }
  }

  /** Links are where their frames are; those without a pose are not drawn. */
  update() {
    const missing = [];
    for (const { frame, group, visuals, collisions } of this.#links) {
      const pose = this.#view.poseOf(frame);
      group.visible = pose !== null;
      if (pose) setPose(group, pose);
      else if (visuals.children.length || collisions.children.length) missing.push(frame);
    }
    const more = missing.length > 1 ? ` (and ${missing.length - 1} more)` : "";
    this.#missing = missing.length ? `No transform from [${missing[0]}]${more}` : "";
    this.#report();
  }

  dispose() {
    this.#generation += 1;
  }

  #shapes(shapes, color) {
    const group = new Group();
    for (const shape of shapes) {
      const holder = setPose(new Group(), shape.origin);
      group.add(holder);
      if (shape.shape === "mesh") this.#addMesh(holder, shape, color);
      else holder.add(this.#body(shape, color ?? shape.color ?? PLAIN_COLOR));
    }
    return group;
  }

  #body({ shape, size, texture }, color) {
    const [a, b] = size;
    const sizes = { box: size, sphere: [2 * a, 2 * a, 2 * a], cylinder: [2 * a, 2 * a, b] };
    const body = makeBody(shape, sizes[shape], texture ? [255, 255, 255, color[3]] : color);
    if (texture) this.#addTexture(body.material, texture);
    return body;
  }

  #addTexture(material, path) {
    const address = new URL(`.${path}`, document.baseURI).href;
    material.map = new TextureLoader().load(address, () => this.#view.requestDraw(), undefined,
      () => this.#fail(`The texture ${path} cannot be loaded`));
    material.map.colorSpace = SRGBColorSpace;
  }

  async #addMesh(holder, { mesh, size, color: own }, color) {
    const generation = this.#generation;
    try {
      const { object, isOwn, problem } = await loadMesh(mesh);
      if (generation !== this.#generation) {
        free(object);
        return;
      }
      const wanted = color ?? own;
      if (wanted || !isOwn) paint(object, wanted);
      object.scale.multiply({ x: size[0], y: size[1], z: size[2] });
      object.userData.alpha = (wanted?.[3] ?? 255) / 255;
      holder.add(object);
      this.setOptions(this.#options);
      if (problem) this.#fail(problem);
    } catch (error) {
      if (generation !== this.#generation) return;
      holder.add(makePlaceholder());
      this.#fail(error.message);
    }
    this.#view.grown?.();
    this.#view.requestDraw();
  }

  #fail(text) {
    this.#problem ||= text;
    this.#report();
  }

  /** One line: what the user can mend first. */
  #report() {
    this.#view.report?.(this.#problem || this.#missing);
  }
}

/** Make all materials below an object more transparent by this factor. */
function fade(object, alpha) {
  object.traverse((each) => {
    for (const material of [each.material].flat()) {
      if (!material) continue;
      material.userData.alpha ??= alphaAbove(each) * material.opacity;
      material.opacity = material.userData.alpha * alpha;
      material.transparent = material.opacity < 1;
      material.depthWrite = material.opacity >= 1;
    }
  });
}

function alphaAbove(object) {
  let at = object;
  while (at && at.userData.alpha === undefined) at = at.parent;
  return at?.userData.alpha ?? 1;
}
