// The addresses of the page's files: next to it on a static host, or unpacked by folder.js.

const unpacked = globalThis.unpackedFiles; // { path: blob }
const published = {};

/** Whether the page was opened from a folder, without a host. */
export const isFromFolder = unpacked !== undefined;

/** Address of a file of the page. */
export function addressOf(path) {
  if (!unpacked) return new URL(path, document.baseURI).href;
  return (published[path] ??= URL.createObjectURL(unpacked[path]));
}

/** Fetch a file of the page. */
export async function fetchFile(path) {
  const response = await fetch(addressOf(path));
  if (!response.ok) throw new Error(`${path}: ${response.status} ${response.statusText}`);
  return response;
}

/** The files by path: addresses, or blobs, since a worker cannot fetch a blob of such a page. */
export function filesForWorker(files) {
  return Object.fromEntries(files.map(({ path }) => [path, unpacked?.[path] ?? addressOf(path)]));
}
