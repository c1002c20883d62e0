// A window over the scene with a picture: it finds a free place, and is moved by its caption.
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

const GAP_PX = 12;
const CASCADE_PX = 28;
const STEP_PX = 20; // of an arrow key
const STEPS = {
  ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1],
};

const windows = new Set();
let front = 0;

export class PictureWindow {
  canvas = document.createElement("canvas");
  #frame = document.createElement("figure");
  #caption = document.createElement("figcaption");
  #name = document.createElement("b");
  #details = document.createElement("span");
  #isWanted = true;
  #hasPicture = false;
  #around = document.getElementById("viewport");
  #watch = new ResizeObserver(() => this.#move(this.#place()));

  /** `close()`: the user does not want to see it. */
  constructor(close) {
    this.canvas.setAttribute("role", "img");
    this.#frame.className = "image-window";
    this.#frame.hidden = true; // until there is a picture
    this.#caption.append(this.#name, " ", this.#details);
    this.#frame.append(this.#caption, closeButton(close), this.canvas);
    this.#makeMovable();
    layer(this.#around).append(this.#frame);
    windows.add(this);
  }

  /** Show a picture of this size, which the caller draws on `canvas`. */
  fit(width, height) {
    const { canvas } = this;
    const isSame = canvas.width === width && canvas.height === height;
    if (!isSame) Object.assign(canvas, { width, height });
    if (this.#hasPicture) return;
    this.#hasPicture = true;
    this.setVisible(this.#isWanted);
  }

  /** What the caption says: whose picture it is, and what is known of it. */
  label(name, details) {
    this.#name.textContent = name;
    this.#details.textContent = details;
    this.canvas.setAttribute("aria-label", `Image of ${name}, ${details}`);
  }

  setVisible(isVisible) {
    const wasHidden = this.#frame.hidden;
    this.#isWanted = isVisible;
    this.#frame.hidden = !isVisible || !this.#hasPicture;
    if (!wasHidden || this.#frame.hidden) return;
    this.#move(this.#frame.style.left ? this.#place() : this.#freePlace());
    this.#raise();
    this.#watch.observe(this.#around);
  }

  remove() {
    windows.delete(this);
    this.#watch.disconnect();
    this.#frame.remove();
  }

  /** Left, top, width and height within the viewport [px]. */
  #box() {
    const { offsetLeft, offsetTop, offsetWidth, offsetHeight } = this.#frame;
    return [offsetLeft, offsetTop, offsetWidth, offsetHeight];
  }

  #place() {
    return this.#box().slice(0, 2);
  }

  /** As near as possible, with all of it in the viewport, and its caption below the buttons. */
  #move([left, top]) {
    if (this.#frame.hidden) return;
    const { highest, lowest, rightmost } = this.#limits();
    this.#frame.style.left = `${Math.max(0, Math.min(left, rightmost))}px`;
    this.#frame.style.top = `${Math.max(highest, Math.min(top, lowest))}px`;
  }

  /** The least and the greatest `top`, and the greatest `left`. */
  #limits() {
    const { clientWidth, clientHeight } = this.#around;
    const [, , width, height] = this.#box();
    const bars = [...this.#around.querySelectorAll(".bar")];
    const free = Math.max(0, ...bars.map((bar) => bar.offsetTop + bar.offsetHeight));
    const lowest = Math.max(0, clientHeight - height);
    return { highest: Math.min(free, lowest), lowest, rightmost: clientWidth - width };
  }

  /** From the lower left corner to the right, then above; a cascade when all is taken. */
  #freePlace() {
    const [, , width, height] = this.#box();
    const { highest, lowest, rightmost } = this.#limits();
    const others = [...windows].filter((each) => each !== this && !each.#frame.hidden)
      .map((each) => each.#box());
    const bottom = Math.max(highest, lowest - GAP_PX);
    for (let top = bottom; top >= highest; top -= height + GAP_PX) {
      for (let left = GAP_PX; left <= rightmost; left += width + GAP_PX) {
        if (!others.some((other) => overlap(other, [left, top, width, height]))) return [left, top];
      }
    }
    const room = Math.max(1, Math.floor((lowest - highest) / CASCADE_PX));
    const shift = CASCADE_PX * (others.length % room);
    return [GAP_PX + shift, highest + shift];
  }

  #raise() {
    this.#frame.style.zIndex = String((front += 1));
  }

  /** By the caption, with a pointer or with arrow keys. */
  #makeMovable() {
    const caption = this.#caption;
    caption.tabIndex = 0;
    caption.title = "Drag, or use the arrow keys, to move the image";
    this.#frame.addEventListener("pointerdown", () => this.#raise());
    caption.addEventListener("keydown", (event) => {
      const step = STEPS[event.key];
      if (!step) return;
      event.preventDefault();
      const [left, top] = this.#place();
      this.#move([left + STEP_PX * step[0], top + STEP_PX * step[1]]);
    });
    caption.onpointerdown = (event) => {
      caption.setPointerCapture(event.pointerId);
      const [left, top] = this.#place();
      caption.onpointermove = ({ clientX, clientY }) => {
        this.#move([left + clientX - event.clientX, top + clientY - event.clientY]);
      };
    };
    for (const ending of ["onpointerup", "onpointercancel"]) {
      caption[ending] = () => { caption.onpointermove = null; };
    }
  }
}

function overlap([x, y, width, height], [left, top, across, down]) {
  return x < left + across && left < x + width && y < top + down && top < y + height;
}

function closeButton(close) {
  const button = document.createElement("button");
  Object.assign(button, { type: "button", textContent: "✕", title: "Hide the image" });
  button.setAttribute("aria-label", "Hide the image");
  button.onclick = close;
  return button;
}

/** All windows are in one element, so that the buttons of the scene stay above them. */
function layer(viewport) {
  const known = viewport.querySelector("#image-windows");
  if (known) return known;
  const made = document.createElement("div");
  made.id = "image-windows";
  viewport.querySelector("canvas").after(made);
  return made;
}
