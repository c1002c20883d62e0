// The parts of a display, each at a pose or below a frame that moves.

import { Group } from "three";

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
