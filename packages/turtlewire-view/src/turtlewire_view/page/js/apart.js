// Pictures of the scene that are not on the page's canvas: what another camera sees.

import { Color, SRGBColorSpace, WebGLRenderTarget } from "three";

const targets = new WeakMap(); // renderer to what it draws apart on

/** Draw the scene as `camera` sees it. Returns an ImageData, clear where nothing is drawn. */
export function drawApart(renderer, scene, camera, [width, height]) {
  const target = targetOf(renderer);
  target.setSize(width, height);
  const { background } = scene;
  const clear = renderer.getClearColor(new Color());
  const alpha = renderer.getClearAlpha();
  scene.background = null;
  renderer.setClearColor(0, 0);
  renderer.setRenderTarget(target);
  const bytes = new Uint8Array(4 * width * height);
  try {
    renderer.render(scene, camera);
    renderer.readRenderTargetPixels(target, 0, 0, width, height, bytes);
  } finally {
    renderer.setRenderTarget(null);
    renderer.setClearColor(clear, alpha);
    scene.background = background;
  }
  return imageOf(bytes, width, height);
}

/** What `act()` returns while some objects are hidden. */
export function without(objects, act) {
  const seen = objects.filter(({ visible }) => visible);
  for (const object of seen) object.visible = false;
  try {
    return act();
  } finally {
    for (const object of seen) object.visible = true;
  }
}

function targetOf(renderer) {
  let target = targets.get(renderer);
  if (target) return target;
  const samples = renderer.getContextAttributes().antialias ? 4 : 0;
  target = new WebGLRenderTarget(1, 1, { samples });
  // For other targets, three.js leaves some colours linear, or the driver converts them twice.
  target.isXRRenderTarget = true;
  target.texture.colorSpace = SRGBColorSpace;
  target.texture.internalFormat = "RGBA8";
  targets.set(renderer, target);
  return target;
}

/** Rows from the top, and colours that are not multiplied by their alpha. */
function imageOf(bytes, width, height) {
  const image = new ImageData(width, height);
  const row = 4 * width;
  for (let y = 0; y < height; y += 1) {
    image.data.set(bytes.subarray(row * (height - 1 - y), row * (height - y)), row * y);
  }
  const { data } = image;
  for (let k = 3; k < data.length; k += 4) {
    const alpha = data[k];
    if (alpha === 0 || alpha === 255) continue;
    for (let c = k - 3; c < k; c += 1) data[c] = (255 * data[c]) / alpha;
  }
  return image;
}
