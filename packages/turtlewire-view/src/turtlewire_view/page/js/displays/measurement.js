// Temperature, RelativeHumidity, FluidPressure and Illuminance: a ball, and the number above it.

import { bytesOf } from "./parts/common.js";
import { Display } from "./parts/display.js";
import { makeBody } from "./parts/solids.js";
import { makeText } from "./parts/text.js";

export default class Measurement extends Display {
  draw(group, { text, color }) {
    const { size, alpha, text_size: height, text_color: ink } = this.options;
    group.add(makeBody("sphere", [size, size, size], [...color.slice(0, 3), 255 * alpha]));
    if (height === 0) return;
    const label = makeText(text, height, bytesOf(ink));
    label.position.set(0, 0, size / 2 + height);
    group.add(label);
  }
}
