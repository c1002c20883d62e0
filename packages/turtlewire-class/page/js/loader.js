// The first load: the service worker, the files, and the stages that Run waits for.

import { fetchFile } from "./files.js";

// A browser that refuses service workers may do so by never answering.
const PATIENCE_MS = 20_000;
const ISOLATION_TRIED = "lesson-isolation-tried";

const byId = (id) => document.getElementById(id);

/** Show which stage is under way; `text` says so in short. Nothing once all is loaded, or lost. */
export function showStage(name, text) {
  if (byId("loading").hidden || byId("stages").hidden) return;
  const stages = [...byId("stages").children];
  const current = stages.findIndex(({ dataset }) => dataset.stage === name);
  stages.forEach((stage, k) => {
    stage.dataset.state = k < current ? "done" : k === current ? "current" : "waiting";
  });
  if (name !== "fetch") byId("loading-bar").removeAttribute("value");
  byId("status").dataset.state = "loading";
  byId("status").textContent = text;
}

/** Install the service worker; the page is loaded once more if that isolates it. */
export async function prepareOffline() {
  if (!("serviceWorker" in navigator) || !isSecureContext) return;
  try {
    const isThere = await Promise.race([registered(), later(PATIENCE_MS)]);
    if (!isThere) return;
  } catch {
    return; // private windows may refuse it: the lesson works, but only with a network
  }
  if (!crossOriginIsolated && !sessionStorage.getItem(ISOLATION_TRIED)) {
    sessionStorage.setItem(ISOLATION_TRIED, "yes");
    location.reload();
    await new Promise(() => {}); // the page ends here
  }
}

const later = (milliseconds) => new Promise((resolve) => setTimeout(resolve, milliseconds));

/** Wait until a service worker answers this page's requests. */
async function registered() {
  await navigator.serviceWorker.register("sw.js");
  await navigator.serviceWorker.ready;
  if (!navigator.serviceWorker.controller) {
    await new Promise((resolve) => {
      navigator.serviceWorker.addEventListener("controllerchange", resolve, { once: true });
    });
  }
  return true;
}

/** Fetch all files, so that they are there offline; `onProgress(done, total)` in bytes. */
export async function fetchAll(files, onProgress) {
  const total = files.reduce((sum, { bytes }) => sum + bytes, 0);
  let done = 0;
  await Promise.all(files.map(async ({ path }) => {
    const reader = (await fetchFile(path)).body.getReader();
    for (let part = await reader.read(); !part.done; part = await reader.read()) {
      done += part.value.length;
      onProgress(done, total);
    }
  }));
}
