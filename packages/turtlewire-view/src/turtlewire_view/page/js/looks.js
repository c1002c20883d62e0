// The buttons on the picture: cameras, and what is drawn.

import { byId, setText } from "./dom.js";

/**
 * Wire the buttons to the stage; `selected()` is the selected frame's name. Returns `show()`, which
 * makes the buttons tell the truth, and `keys`: key to action.
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
  byId("picture").onclick = async () => save(await view.picture(), "png");
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

/** Hand a file to the user. */
export function save(blob, suffix) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(blob);
  link.download = `view-${new Date().toISOString().slice(0, 19).replaceAll(":", "-")}.${suffix}`;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}

function setPressed(button, on) {
  button.setAttribute("aria-pressed", String(on));
}
