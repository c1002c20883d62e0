// The buttons on the picture: cameras, and what is drawn.

import { byId, setText } from "../kit/dom.js";
import { download } from "../kit/download.js";

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
