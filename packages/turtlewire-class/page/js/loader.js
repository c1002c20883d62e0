// The first load: the files, and the stages that Run waits for.

import { byId } from "../kit/dom.js";
import { fetchFile } from "./files.js";

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
