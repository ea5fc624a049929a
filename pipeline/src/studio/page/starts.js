// The values with which settings start: such that the object keeps its shape nearly, and no fault appears.

import { known, valueOf } from "./store.js";

const short = (x) => Number(x.toPrecision(2));

/** Returns the largest extent of the opened objects, in the unit of length. */
export function sizeOf() {
  const points = Object.values(known.curves.specs).flat().flatMap((part) => part.stations.flat());
  const extent = [0, 1, 2].map((axis) => points.reduce(([low, high], p) => [Math.min(low, p[axis]), Math.max(high, p[axis])], [Infinity, -Infinity]));
  const size = Math.max(...extent.map(([low, high]) => high - low));
  return size > 0 && Number.isFinite(size) ? size : 1;
}

/** Returns whether the sweep that holds a path of a spec is a rotation, whose contour is a profile. */
function isRotation(spec, path) {
  const sweep = path[0] === "parts" ? spec?.parts?.[path[1]] : spec;
  return sweep?.trajectory?.rotation !== undefined;
}

/** Returns the value with which the setting at a path of a file starts, or undefined if its schema says enough. */
export function suggested(file, path) {
  const last = path[path.length - 1], list = path[path.length - 2];
  const size = sizeOf(), scene = file === known.state.scene, value = valueOf(file);
  if (!scene) {
    const waves = isRotation(value, path) ? { u: 0, v: 12 } : { u: 12 };
    const term = { amp: short(0.015 * size), ...waves };
    if (last === "depth") return { mode: "offset", terms: [term] };
    if (list === "terms") return term;
    if (last === "wall") return short(0.03 * size);
    if (last === "copies") return { count: 2, step: [{ translate: [short(size), 0, 0] }] };
    if (list === "place") return { translate: [0, 0, 0] };
    if (list === "deform") return { twist: { axis: [0, 1, 0], degrees: 30, from: 0, to: short(size) } };
    if (list === "areas") {
      const { rows, cols } = (path[0] === "parts" ? value.parts[path[1]] : value).mesh || {};
      return { rows: [0, Math.ceil((rows ?? 2) / 2)], cols: [0, Math.ceil((cols ?? 2) / 2)], texture: 1 };
    }
    return undefined;
  }
  const material = Object.keys(value?.materials || {})[0];
  const of = material ? { material } : {};
  if (list === "textures" && path.length === 2) return { marble: {}, place: { scale: short(0.3 * size) } };
  if (list === "materials" && path.length === 2) return { color: [0.8, 0.8, 0.8], diffuse: 0.9 };
  if (list === "lights") return { directional: { direction: [-0.5, -0.8, -0.3], color: 0.4 } };
  if (list === "objects") return { sphere: { center: [short(size), short(0.25 * size), 0], radius: short(0.25 * size), ...of } };
  if (last === "bump") return { noise: {}, strength: short(0.02 * size) };
  return undefined;
}
