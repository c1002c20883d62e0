// The field below the drawing: its colour, a little light, and lines one metre apart.

import { FIELD_METRES, IMAGE_PIXELS, PIXELS_PER_METRE } from "./frames.js";

const [LIGHT, DARK] = ["255 255 255", "12 17 60"];
const EVEN = 0.197; // luminance from which both stand out alike

/** Fill the square canvas of `ctx`; `background` is [red, green, blue]. */
export function paintGround(ctx, background) {
  const size = ctx.canvas.width;
  ctx.fillStyle = `rgb(${background.join(" ")})`;
  ctx.fillRect(0, 0, size, size);
  const [x, y, middle, radius] = [0.35, 0.25, 0.5, 0.8].map((share) => share * size);
  const light = ctx.createRadialGradient(x, y, 0, middle, middle, radius);
  light.addColorStop(0, "rgb(255 255 255 / 9%)");
  light.addColorStop(1, "rgb(0 0 20 / 14%)");
  ctx.fillStyle = light;
  ctx.fillRect(0, 0, size, size);
  paintLines(ctx, size, isDark(background) ? [LIGHT, DARK] : [DARK, LIGHT]);
}

/** Whether white stands out from a colour more than dark blue does. */
function isDark(rgb) {
  const [r, g, b] = rgb.map((byte) => {
    const share = byte / 255;
    return share <= 0.04045 ? share / 12.92 : ((share + 0.055) / 1.055) ** 2.4;
  });
  return 0.2126 * r + 0.7152 * g + 0.0722 * b < EVEN;
}

function paintLines(ctx, size, [ink, halo]) {
  const pixel = size / IMAGE_PIXELS;
  const font = Math.max(12 * devicePixelRatio, size / 62);
  ctx.font = `${font}px system-ui, sans-serif`;
  ctx.lineWidth = Math.max(1, size / 1000);
  for (let metre = 0; metre <= FIELD_METRES; metre += 1) {
    const x = (metre * PIXELS_PER_METRE + 0.5) * pixel;
    const y = size - (metre * PIXELS_PER_METRE + 0.5) * pixel;
    ctx.strokeStyle = metre % 5 ? `rgb(${ink} / 7%)` : `rgb(${ink} / 16%)`;
    ctx.beginPath();
    ctx.moveTo(x, 0);
    ctx.lineTo(x, size);
    ctx.moveTo(0, y);
    ctx.lineTo(size, y);
    ctx.stroke();
    if (metre === 0 || metre === 11) continue;
    ctx.fillStyle = `rgb(${ink})`;
    ctx.strokeStyle = `rgb(${halo} / 40%)`;
    ctx.textAlign = "center";
    ctx.textBaseline = "bottom";
    write(ctx, `${metre}`, x, size - 0.35 * font, font);
    ctx.textAlign = "left";
    ctx.textBaseline = "middle";
    write(ctx, metre === 10 ? "10 m" : `${metre}`, 0.45 * font, y, font);
  }
}

/** A text in a halo, which makes it readable on colours that are neither light nor dark. */
function write(ctx, text, x, y, font) {
  ctx.save();
  ctx.lineJoin = "round";
  ctx.lineWidth = 0.35 * font;
  ctx.strokeText(text, x, y);
  ctx.fillText(text, x, y);
  ctx.restore();
}
