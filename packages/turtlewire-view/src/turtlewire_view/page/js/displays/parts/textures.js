// Images on triangles, from bytes that came with a message or from the server.

import { RepeatWrapping, SRGBColorSpace, Texture } from "three";

/**
 * The texture of a header's `texture` ({ url, name }), or of encoded `bytes`; v goes down.
 * Raises an Error that says what is wrong.
 */
export async function loadTexture({ url, name }, bytes) {
  const blob = bytes ? new Blob([bytes]) : await fetchImage(url, name);
  let bitmap;
  try {
    bitmap = await createImageBitmap(blob);
  } catch {
    throw new Error(`'${name}' is not an image that this browser can read`);
  }
  const texture = new Texture(bitmap);
  texture.flipY = false;
  texture.colorSpace = SRGBColorSpace;
  texture.wrapS = texture.wrapT = RepeatWrapping;
  texture.needsUpdate = true;
  texture.addEventListener("dispose", () => bitmap.close());
  return texture;
}

async function fetchImage(url, name) {
  const address = new URL(`.${url}`, document.baseURI); // the page may have its own path
  const answer = await fetch(address);
  if (!answer.ok) throw new Error(`'${name}' cannot be loaded: ${(await answer.text()).trim()}`);
  return answer.blob();
}
