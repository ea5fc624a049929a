// Controls of colours, which files state as linear light.

import { make } from "./toolbar.js";

const coded = (light) => (light <= 0.0031308 ? 12.92 * light : 1.055 * light ** (1 / 2.4) - 0.055);
const light = (code) => (code <= 0.04045 ? code / 12.92 : ((code + 0.055) / 1.055) ** 2.4);

/** Returns three numbers of a colour that is a number or a list; null for other values. */
export function channels(value) {
  if (typeof value === "number") return [value, value, value];
  return Array.isArray(value) && value.length === 3 && value.every((one) => typeof one === "number") ? value : null;
}

/** Returns whether the variants of a schema are those of a colour: a number, or three numbers. */
export const isColor = (variants) =>
  variants.some((one) => one.type === "number") && variants.some((one) => one.type === "array" && one.minItems === 3 && one.maxItems === 3);

const hex = (all) => "#" + all.map((one) => Math.round(255 * coded(Math.min(1, Math.max(0, one)))).toString(16).padStart(2, "0")).join("");

/** Returns the code of a colour for a control of the browser; grey for values that are no colour. */
export const hexOf = (value) => hex(channels(value) || [0.216, 0.216, 0.216]);

/** Makes the controls of a colour: the colour itself, and its channels as numbers. `send` gets the new value. */
export function colorControls(name, path, value, send) {
  const now = channels(value);
  const picker = make("input", { type: "color", value: hexOf(value), title: `${name}: colours above 1 are typed` });
  picker.setAttribute("aria-label", `${name}, colour`);
  picker.dataset.color = JSON.stringify(path);
  picker.addEventListener("change", () => {
    send([1, 3, 5].map((k) => Number(light(parseInt(picker.value.slice(k, k + 2), 16) / 255).toPrecision(3))));
  });
  const numbers = ["red", "green", "blue"].map((channel, k) => {
    const own = make("input", { type: "number", step: "any", min: 0, value: now?.[k] ?? "" });
    own.setAttribute("aria-label", `${name}, ${channel}, linear`);
    own.dataset.path = JSON.stringify(Array.isArray(value) ? [...path, k] : path);
    own.addEventListener("change", () => {
      if (own.value === "") return;
      const all = numbers.map((one) => (one.value === "" ? Number(own.value) : Number(one.value)));
      send(all.every((one) => one === all[0]) ? all[0] : all);
    });
    return own;
  });
  return [picker, ...numbers];
}
