// The buttons on the picture: cameras, what is drawn, and views as .rviz files, which the browser
// saves, the user chooses, and the server reads and writes.

import { byId, setText } from "../kit/dom.js";
import { download } from "../kit/download.js";

const SWITCHES = ["names", "axes", "arrows", "grid"];
const LARGEST_FILE = 60_000; // bytes of a command that the server takes

/**
 * Wire the buttons to the stage; `selected()` is the selected frame's name. Returns `show()`, which
 * updates the buttons to the current state, and `keys`: key to action.
 */
export function listenForLooks(stage, selected) {
  const { cameras, view } = stage;
  const choose = (kind) => cameras.choose(kind);
  const follow = () => cameras.follow(cameras.followed ? "" : selected());
  byId("orbit").onclick = () => choose("orbit");
  byId("top").onclick = () => choose("top");
  byId("follow").onclick = follow;
  byId("fit").onclick = () => stage.fit();
  listenForSwitches(stage);
  byId("size").oninput = ({ target }) => stage.setSize(10 ** Number(target.value));
  byId("picture").onclick = async () => download(await view.picture(), "view", "png");
  return {
    keys: { o: () => choose("orbit"), t: () => choose("top"), f: follow, Home: () => stage.fit() },
    show: () => {
      for (const kind of ["orbit", "top"]) setPressed(byId(kind), cameras.kind === kind);
      setPressed(byId("follow"), cameras.followed !== "");
      byId("follow").disabled = !cameras.followed && !selected();
      byId("size").value = Math.log10(stage.drawing.size);
      const following = cameras.followed ? ` · following ${cameras.followed}` : "";
      setText(byId("caption"), `grid ${view.grid.cell} m${following}`);
    },
  };
}

function listenForSwitches(stage) {
  const switches = {
    "show-names": (on) => { stage.labels.showAll = on; },
    "show-axes": (on) => { stage.drawing.show.axes = on; },
    "show-arrows": (on) => { stage.drawing.show.arrows = on; },
    "show-grid": (on) => { stage.view.grid.object.visible = on; },
  };
  for (const [id, act] of Object.entries(switches)) {
    byId(id).onchange = ({ target }) => {
      act(target.checked);
      stage.change();
    };
  }
}

function setPressed(button, on) {
  button.setAttribute("aria-pressed", String(on));
}

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
