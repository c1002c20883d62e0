// The picture of an Image or CompressedImage as something that a canvas draws.

/** Turns contents into pictures; of files that take long, only the newest one. */
export class Pictures {
  #latest = 0;

  /**
   * Resolves to `{ picture, width, height }` with the full size of the image, or to null if a newer
   * one has come. Raises an Error if the browser cannot read it.
   */
  async read(header, arrays, shapes) {
    this.#latest += 1;
    const mine = this.#latest;
    if (arrays.rgba) {
      const { width, height } = header;
      return { picture: pixelsOf(arrays.rgba, shapes.rgba), width, height };
    }
    let bitmap;
    try {
      const blob = new Blob([arrays.file.slice()], { type: header.media_type });
      bitmap = await createImageBitmap(blob);
    } catch {
      if (mine !== this.#latest) return null;
      throw new Error(`The browser cannot read this ${header.media_type}`);
    }
    if (mine !== this.#latest) {
      bitmap.close();
      return null;
    }
    const { width, height } = bitmap;
    return { picture: bitmap, width, height };
  }

  /** No picture is wanted any more. */
  stop() {
    this.#latest += 1;
  }
}

function pixelsOf(rgba, [height, width]) {
  const canvas = new OffscreenCanvas(width, height);
  const bytes = new Uint8ClampedArray(rgba.buffer, rgba.byteOffset, rgba.length);
  canvas.getContext("2d").putImageData(new ImageData(bytes.slice(), width, height), 0, 0);
  return canvas;
}
