// Image and CompressedImage: a window over the scene with the picture.

import { PictureWindow } from "./parts/picture_window.js";

export default class ImageDisplay {
  #view;
  #window;
  #latest = 0;

  constructor(view) {
    this.#view = view;
    this.#window = new PictureWindow(() => view.hide());
  }

  show(_group, header, arrays, shapes) {
    if (arrays.rgba) this.#showPixels(header, arrays.rgba, shapes.rgba);
    else this.#showFile(header, arrays.file);
  }

  setVisible(isVisible) {
    this.#window.setVisible(isVisible);
  }

  setOptions() {}

  dispose() {
    this.#latest += 1;
    this.#window.remove();
  }

  #showPixels(header, rgba, [height, width]) {
    this.#latest += 1;
    const bytes = new Uint8ClampedArray(rgba.buffer, rgba.byteOffset, rgba.length);
    this.#label(header, header.width, header.height);
    this.#window.fit(width, height);
    const picture = new ImageData(bytes.slice(), width, height);
    this.#window.canvas.getContext("2d").putImageData(picture, 0, 0);
  }

  async #showFile(header, file) {
    this.#latest += 1;
    const mine = this.#latest;
    try {
      const blob = new Blob([file.slice()], { type: header.media_type });
      const bitmap = await createImageBitmap(blob);
      if (mine === this.#latest) {
        this.#label(header, bitmap.width, bitmap.height);
        this.#window.fit(bitmap.width, bitmap.height);
        this.#window.canvas.getContext("2d").drawImage(bitmap, 0, 0);
        this.#view.report?.("");
      }
      bitmap.close();
    } catch {
      if (mine !== this.#latest) return;
      this.#view.report?.(`The browser cannot read this ${header.media_type}`);
    }
  }

  #label({ encoding, camera }, width, height) {
    const frame = camera ? ` · ${camera}` : "";
    this.#window.label(this.#view.topic, `${width} × ${height} · ${encoding}${frame}`);
  }
}
