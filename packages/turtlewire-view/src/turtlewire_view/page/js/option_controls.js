// A control for an option of a display, by the option's type.

import { make } from "../kit/dom.js";

const MAKERS = {
  bool: (value, changed) => {
    const input = make("input", { type: "checkbox", checked: Boolean(value) });
    input.onchange = () => changed(input.checked);
    return input;
  },
  number: (value, changed, { min, max, step = "any" }) => {
    const input = make("input", { type: "number", value: String(value), step });
    if (min !== undefined) input.min = min;
    if (max !== undefined) input.max = max;
    input.onchange = () => {
      if (input.value !== "" && input.checkValidity()) changed(input.valueAsNumber);
      else input.reportValidity();
    };
    return input;
  },
  choice: (value, changed, { choices }) => {
    const input = make("select", {}, ...choices.map((choice) => new Option(choice, choice)));
    input.value = value;
    input.onchange = () => changed(input.value);
    return input;
  },
  color: (value, changed) => {
    const input = make("input", { type: "color", value });
    input.oninput = () => changed(input.value);
    return input;
  },
  text: (value, changed) => {
    const input = make("input", { type: "text", value: value ?? "", spellcheck: false });
    input.onchange = () => changed(input.value);
    return input;
  },
};

/** A label and its control; `changed(value)` when the user has chosen. */
export function optionControl(id, option, value, changed) {
  const control = (MAKERS[option.type] ?? MAKERS.text)(value, changed, option);
  control.id = id;
  const label = make("label", { textContent: option.label ?? option.name });
  label.htmlFor = id;
  return [label, control];
}
