// Views as .rviz files: saved by the browser, chosen by the user; the server reads and writes them.

import { byId } from "../kit/dom.js";
import { download } from "../kit/download.js";

const SWITCHES = ["names", "axes", "arrows", "grid"];
const LARGEST_FILE = 60_000; // bytes of a command that the server takes

/**
 * Wire the buttons. `view()` is { fixed, displays, document, camera }; `say(text)` tells the user.
 */
export function listenForFiles(view, send, say) {
  byId("save-view").onclick = () => {
    const { fixed, displays: list, document, camera } = view();
    const displays = list.map(({ kind, topic, options, visible, place }) => {
      return { kind, topic, options, visible, place };
    });
    const show = Object.fromEntries(SWITCHES.map((name) => [name, byId(`show-${name}`).checked]));
    send({ type: "save", fixed, document, displays, show, camera });
  };
  byId("load-view").onclick = () => byId("view-file").click();
  byId("view-file").onchange = async ({ target }) => {
    const [file] = target.files;
    target.value = ""; // the same file can be chosen again
    if (!file) return;
    if (file.size > LARGEST_FILE) say(`${file.name} is too large for a .rviz file.`);
    else send({ type: "load", text: await file.text() });
  };
}

/** The server has written the file. */
export function takeSaved({ text }) {
  download(new Blob([text], { type: "application/yaml" }), "view", "rviz");
}

/** Set the switches of what is drawn. */
export function applySwitches(show = {}) {
  for (const name of SWITCHES) {
    const input = byId(`show-${name}`);
    if (show[name] === undefined || input.checked === show[name]) continue;
    input.checked = show[name];
    input.dispatchEvent(new Event("change"));
  }
}
