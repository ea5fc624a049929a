// Buttons and typed numbers above an editor of curves.

import { options } from "./planar.js";

/** Makes an element with properties and children. */
export function make(name, properties = {}, ...children) {
  const { dataset, ...rest } = properties;
  const element = Object.assign(document.createElement(name), rest);
  Object.assign(element.dataset, dataset || {});
  element.append(...children.filter((child) => child !== null && child !== undefined));
  return element;
}

/** Makes a button with a name, a title and an action. */
export const button = (text, title, onclick, className = "") =>
  make("button", { type: "button", textContent: text, title, onclick, className });

/** Makes a button that stays pressed and sets one of the options. */
export function toggle(text, title, key) {
  const own = button(text, title, () => {
    options[key] = !options[key];
    own.setAttribute("aria-pressed", options[key]);
  });
  own.setAttribute("aria-pressed", options[key]);
  return own;
}

/** Makes fields for the coordinates of the chosen handle. `typed` gets the new coordinates. */
export function fields(names, typed, of = "of the chosen handle") {
  const inputs = names.map((name) => {
    const input = make("input", { type: "number", step: "any", disabled: true });
    input.setAttribute("aria-label", `${name} ${of}`);
    input.addEventListener("change", () => {
      const values = inputs.map((one) => Number(one.value));
      if (values.every(Number.isFinite)) typed(values);
    });
    return input;
  });
  const labels = names.map((name, k) => make("label", {}, `${name} `, inputs[k]));
  const show = (at) => inputs.forEach((input, k) => {
    input.disabled = !at;
    if (document.activeElement !== input) input.value = at ? Number(at[k].toPrecision(9)) : "";
  });
  return { labels, show, group: make("span", { className: "pair" }, ...labels) };
}
