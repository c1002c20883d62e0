// The field below the drawing: its colour, a little light, and lines one metre apart.

import { FIELD_METRES, IMAGE_PIXELS, PIXELS_PER_METRE } from "./frames.js";

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
  paintLines(ctx, size);
}

function paintLines(ctx, size) {
  const pixel = size / IMAGE_PIXELS;
  const font = Math.max(9 * devicePixelRatio, size / 62);
  ctx.font = `${font}px system-ui, sans-serif`;
  ctx.lineWidth = Math.max(1, size / 1000);
  for (let metre = 0; metre <= FIELD_METRES; metre += 1) {
    const x = (metre * PIXELS_PER_METRE + 0.5) * pixel;
    const y = size - (metre * PIXELS_PER_METRE + 0.5) * pixel;
    ctx.strokeStyle = metre % 5 ? "rgb(255 255 255 / 7%)" : "rgb(255 255 255 / 16%)";
    ctx.beginPath();
    ctx.moveTo(x, 0);
    ctx.lineTo(x, size);
    ctx.moveTo(0, y);
    ctx.lineTo(size, y);
    ctx.stroke();
    if (metre === 0 || metre === 11) continue;
    ctx.fillStyle = "rgb(255 255 255 / 42%)";
    ctx.textAlign = "center";
    ctx.textBaseline = "bottom";
    ctx.fillText(`${metre}`, x, size - 0.35 * font);
    ctx.textAlign = "left";
    ctx.textBaseline = "middle";
    ctx.fillText(metre === 10 ? "10 m" : `${metre}`, 0.45 * font, y);
  }
}
