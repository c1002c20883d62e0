// Opens the lesson from a folder, without a web server. Browsers import no modules and fetch
// nothing from files, but run this script: the build adds all files of the page to its end, packed,
// and each gets a blob's address here. It is for file: only; a served page never loads it.

const TYPES = { js: "text/javascript", mjs: "text/javascript", wasm: "application/wasm" };
// `from "./editors.js"`: what is imported, in quotation marks.
const IMPORTED = /\b(?:from|import)\s*(["'])([^"'\n]+)\1/g;

/** Unpack the files and start the page; `packed`: { path: base64 of gzip }. */
async function openFromFolder(packed) {
  const { imports } = JSON.parse(document.querySelector("script[type=importmap]").textContent);
  const blobs = {};
  const modules = {}; // promises of their addresses

  /** Path of the file that a module imports; undefined if it is none of ours. */
  function pathOf(name, importer) {
    const path = imports[name] ?? new URL(name, `file:///${importer}`).pathname.slice(1);
    return [path.replace(/^\.\//, "")].find((found) => found in packed);
  }

  async function unpack(path) {
    const bytes = Uint8Array.from(atob(packed[path]), (character) => character.charCodeAt(0));
    const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
    const content = await new Response(stream).arrayBuffer();
    blobs[path] = new Blob([content], { type: TYPES[path.split(".").pop()] ?? "" });
  }

  /** Address of a module in which the addresses of what it imports stand. */
  async function link(path) {
    const source = await blobs[path].text();
    const addresses = {};
    for (const [, , name] of source.matchAll(IMPORTED)) {
      const imported = pathOf(name, path);
      if (imported) addresses[name] = await (modules[imported] ??= link(imported));
    }
    const linked = source.replace(IMPORTED, (text, quote, name) =>
      text.replace(name, addresses[name] ?? name));
    return URL.createObjectURL(new Blob([linked], { type: TYPES.js }));
  }

  await Promise.all(Object.keys(packed).map(unpack));
  globalThis.unpackedFiles = blobs; // for js/files.js
  await import(await link("js/main.js"));
}

