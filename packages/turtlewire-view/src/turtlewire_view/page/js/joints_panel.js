// The joints of a robot that is shown without a network: a slider or dial for each.

import { byId } from "../kit/dom.js";
import { JointRow } from "../kit/joint_row.js";

export class JointsPanel {
  #move;
  #joints = [];
  #rows = [];
  #inDegrees = false;
  #held = null; // the row that the user drags: positions on their way must not move it back

  /** `move(positions)` sends positions by name [rad or m]. */
  constructor(move) {
    this.#move = move;
    byId("center").onclick = () => this.#moveAll(({ zero }) => zero);
    byId("randomize").onclick = () => this.#moveAll(({ minimum, maximum }) => {
      return minimum + Math.random() * (maximum - minimum);
    });
    byId("degrees").onclick = ({ target }) => {
      this.#inDegrees = !this.#inDegrees;
      target.setAttribute("aria-pressed", String(this.#inDegrees));
      for (const row of this.#rows) row.setUnit(this.#inDegrees);
    };
    byId("joint-rows").onpointerdown = ({ target }) => (this.#held = target.closest(".joint"));
    for (const type of ["pointerup", "pointercancel", "blur"]) {
      addEventListener(type, () => (this.#held = null));
    }
  }

  /** The joints as the server describes them. */
  describe(joints) {
    this.#joints = joints;
    this.#rows = joints.map((joint) => {
      return new JointRow(joint, (position) => this.#move({ [joint.name]: position }));
    });
    for (const row of this.#rows) row.setUnit(this.#inDegrees);
    byId("joint-rows").replaceChildren(...this.#rows.map(({ element }) => element));
    byId("joints").hidden = !joints.length;
  }

  /** Positions in the order of the joints [rad or m]. */
  show(positions) {
    this.#rows.forEach((row, k) => {
      if (row.element !== this.#held) row.show(positions[k]);
    });
  }

  #moveAll(positionOf) {
    const free = this.#joints.filter(({ mimic }) => mimic === null);
    this.#move(Object.fromEntries(free.map((joint) => [joint.name, positionOf(joint)])));
  }
}
