// Image and CompressedImage: a window over the scene with the picture.

import { Pictures, PictureWindow } from "./parts/picture_window.js";

export default class ImageDisplay {
  #view;
  #window;
  #pictures = new Pictures();

  constructor(view) {
    this.#view = view;
    this.#window = new PictureWindow(() => view.hide());
  }

  async show(_group, header, arrays, shapes) {
    try {
      const read = await this.#pictures.read(header, arrays, shapes);
      if (read) this.#draw(header, read);
    } catch (error) {
      this.#view.report?.(error.message);
    }
  }

  setVisible(isVisible) {
    this.#window.setVisible(isVisible);
  }

  setOptions() {}

  dispose() {
    this.#pictures.stop();
    this.#window.remove();
  }

  #draw({ encoding, camera }, { picture, width, height }) {
    const frame = camera ? ` · ${camera}` : "";
    this.#window.label(this.#view.topic, `${width} × ${height} · ${encoding}${frame}`);
    this.#window.fit(picture.width, picture.height);
    const ink = this.#window.canvas.getContext("2d");
    ink.clearRect(0, 0, picture.width, picture.height);
    ink.drawImage(picture, 0, 0);
    picture.close?.();
    this.#view.report?.("");
  }
}
