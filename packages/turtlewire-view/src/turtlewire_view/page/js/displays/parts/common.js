// What all displays need: emptying groups, poses, colours.
// Base of displays whose parts are drawn from their last content and the options alone.

import { Color, SRGBColorSpace } from "three";

/** Remove and free everything below an object. */
export function clear(object) {
  for (const child of [...object.children]) {
    object.remove(child);
    free(child);
  }
}

/** Free what the graphics card holds for an object and everything below it. */
export function free(object) {
  object.traverse((each) => {
    if (each.isInstancedMesh) each.dispose();
    each.geometry?.dispose();
    for (const material of [each.material].flat()) {
      if (!material) continue;
      for (const value of Object.values(material)) if (value?.isTexture) value.dispose();
      for (const { value } of Object.values(material.uniforms ?? {})) {
        if (value?.isTexture) value.dispose();
      }
      material.dispose();
    }
  });
}

/**
 * Set `size` (Vector2) to the pixels of what is drawn on: the page, or another camera's picture.
 * Returns the pixels of a CSS pixel there.
 */
export function sizeDrawn(renderer, size) {
  const target = renderer.getRenderTarget();
  if (target) size.set(target.width, target.height);
  else renderer.getDrawingBufferSize(size);
  return target ? 1 : renderer.getPixelRatio();
}

/** Put an object to [x, y, z, qx, qy, qz, qw]. */
export function setPose(object, pose) {
  object.position.fromArray(pose);
  object.quaternion.set(pose[3], pose[4], pose[5], pose[6]);
  return object;
}

/** The bytes of "#rrggbb" and an opacity from 0 to 1. */
export function bytesOf(color, alpha = 1) {
  const number = parseInt(color.slice(1), 16);
  return [number >> 16, (number >> 8) & 255, number & 255, Math.round(255 * alpha)];
}

/** A colour for lit materials, of bytes. */
export function litColor([r, g, b]) {
  return new Color().setRGB(r / 255, g / 255, b / 255, SRGBColorSpace);
}

/** What materials need to be drawn with an opacity from 0 to 1. */
export function opacity(alpha) {
  return { opacity: alpha, transparent: alpha < 1, depthWrite: alpha >= 1 };
}

export class Display {
  view;
  options;
  #parts = new Map(); // name to { group, header, arrays }

  constructor(view, options) {
    this.view = view;
    this.options = options;
  }

  /** Draw a content into its group; what was there is removed before. */
  draw(_group, _header, _arrays) {}

  show(group, header, arrays) {
    this.#parts.set(header.part ?? "", { group, header, arrays });
    this.#redraw(group, header, arrays);
  }

  setOptions(options) {
    this.options = options;
    for (const [part, { group, header, arrays }] of this.#parts) {
      if (group.parent) this.#redraw(group, header, arrays);
      else this.#parts.delete(part);
    }
  }

  removed(part) {
    this.#parts.delete(part);
  }

  #redraw(group, header, arrays) {
    clear(group);
    this.draw(group, header, arrays);
  }
}
