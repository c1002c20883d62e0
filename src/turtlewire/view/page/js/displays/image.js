// Image and CompressedImage: a window over the scene with the picture.

const STYLE = new URL("../../image_window.css", import.meta.url).href;
const OFFSET_PX = 26;

let opened = 0;

export default class ImageWindow {
  #view;
  #window = document.createElement("figure");
  #canvas = document.createElement("canvas");
  #caption = document.createElement("figcaption");
  #latest = 0;

  constructor(view) {
    this.#view = view;
    loadStyle();
    this.#window.className = "image-window";
    this.#window.append(this.#caption, this.#canvas);
    this.#canvas.setAttribute("role", "img");
    const shift = OFFSET_PX * (opened++ % 6);
    this.#window.style.left = `${12 + shift}px`;
    this.#window.style.bottom = `${12 + shift}px`;
    this.#makeMovable();
    document.getElementById("viewport").append(this.#window);
  }

  show(_group, header, arrays, shapes) {
    if (arrays.rgba) this.#showPixels(header, arrays.rgba, shapes.rgba);
    else this.#showFile(header, arrays.file);
  }

  setVisible(isVisible) {
    this.#window.hidden = !isVisible;
  }

  setOptions() {}

  dispose() {
    this.#latest += 1;
    this.#window.remove();
  }

  #showPixels(header, rgba, [height, width]) {
    this.#latest += 1;
    const bytes = new Uint8ClampedArray(rgba.buffer, rgba.byteOffset, rgba.length);
    this.#fit(width, height);
    const picture = new ImageData(bytes.slice(), width, height);
    this.#canvas.getContext("2d").putImageData(picture, 0, 0);
    this.#label(header, header.width, header.height);
  }

  async #showFile(header, file) {
    this.#latest += 1;
    const mine = this.#latest;
    try {
      const blob = new Blob([file.slice()], { type: header.media_type });
      const bitmap = await createImageBitmap(blob);
      if (mine === this.#latest) {
        this.#fit(bitmap.width, bitmap.height);
        this.#canvas.getContext("2d").drawImage(bitmap, 0, 0);
        this.#label(header, bitmap.width, bitmap.height);
        this.#view.report?.("");
      }
      bitmap.close();
    } catch {
      if (mine !== this.#latest) return;
      this.#view.report?.(`The browser cannot read this ${header.media_type}`);
    }
  }

  #fit(width, height) {
    if (this.#canvas.width === width && this.#canvas.height === height) return;
    Object.assign(this.#canvas, { width, height });
  }

  #label({ encoding, camera }, width, height) {
    const text = `${width} × ${height} · ${encoding}${camera ? ` · ${camera}` : ""}`;
    this.#caption.textContent = text;
    this.#canvas.setAttribute("aria-label", `Camera picture, ${text}`);
  }

  /** The caption is a handle; arrow keys are the browser's, for scrolling. */
  #makeMovable() {
    const { style } = this.#window;
    this.#caption.onpointerdown = (event) => {
      this.#caption.setPointerCapture(event.pointerId);
      const from = [event.clientX, event.clientY];
      const start = [parseFloat(style.left), parseFloat(style.bottom)];
      this.#caption.onpointermove = ({ clientX, clientY }) => {
        style.left = `${Math.max(0, start[0] + clientX - from[0])}px`;
        style.bottom = `${Math.max(0, start[1] - clientY + from[1])}px`;
      };
      this.#caption.onpointerup = () => { this.#caption.onpointermove = null; };
    };
  }
}

function loadStyle() {
  if (document.querySelector(`link[href="${STYLE}"]`)) return;
  const link = document.createElement("link");
  Object.assign(link, { rel: "stylesheet", href: STYLE });
  document.head.append(link);
}
