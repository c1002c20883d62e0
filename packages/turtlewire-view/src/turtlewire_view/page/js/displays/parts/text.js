// Text that faces the camera, with a height in metres.

import { CanvasTexture, Sprite, SpriteMaterial, SRGBColorSpace } from "three";

const FONT_PX = 48;
const LINE = 1.25;
const CAPITAL = 0.72; // height of a capital letter, of the font's size
const MOST_LINES = 50;
const WIDEST_PX = 4096;

/** Lines of text; `height` [m] is that of a capital letter, `color` RGBA bytes. */
export function makeText(text, height, color) {
  const lines = text.split("\n", MOST_LINES);
  const canvas = document.createElement("canvas");
  const ink = canvas.getContext("2d");
  ink.font = `${FONT_PX}px system-ui, sans-serif`;
  const widest = Math.max(1, ...lines.map((line) => ink.measureText(line).width));
  canvas.width = Math.min(WIDEST_PX, Math.ceil(widest) + 8);
  canvas.height = Math.ceil(FONT_PX * LINE * lines.length);
  ink.font = `${FONT_PX}px system-ui, sans-serif`;
  ink.textAlign = "center";
  ink.textBaseline = "middle";
  ink.fillStyle = `rgb(${color[0]}, ${color[1]}, ${color[2]})`;
  lines.forEach((line, k) => {
    ink.fillText(line, canvas.width / 2, FONT_PX * LINE * (k + 0.5), canvas.width);
  });
  const map = new CanvasTexture(canvas);
  map.colorSpace = SRGBColorSpace;
  const look = new SpriteMaterial({ map, opacity: color[3] / 255, depthWrite: false });
  const sprite = new Sprite(look);
  const metres = height / (CAPITAL * FONT_PX);
  sprite.scale.set(canvas.width * metres, canvas.height * metres, 1);
  return sprite;
}
