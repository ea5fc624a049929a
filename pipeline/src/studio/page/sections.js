// Several sections along a trajectory: adding, removing and placing them.

import { at as valueAt, insert, remove, set, valueOf } from "./store.js";

/** Returns the sections of a part of a spec with their path, or null. `part` is the index of the part. */
export function sectionsOf(spec, part = 0) {
  const path = Array.isArray(spec?.parts) ? ["parts", part, "contour", "sections"] : ["contour", "sections"];
  const all = valueAt(spec, path);
  return Array.isArray(all) ? { all, path } : null;
}

/** Returns the path of the sections that hold a contour, and its index among them; null if there are none. */
export function sectionOf(path) {
  const k = path.indexOf("sections");
  return k < 0 ? null : { path: path.slice(0, k + 1), index: path[k + 1] };
}

/** Returns the edits that add a section after the one that holds a contour, and the index of the new one. */
export function addedSection(file, path, contour) {
  const own = sectionOf(path);
  if (!own) {
    // One contour becomes two, at the start and at the end.
    const sections = [0, 1].map((at) => ({ at, contour: structuredClone(contour) }));
    return { edits: [set(path, { sections })], index: 1 };
  }
  const all = valueAt(valueOf(file), own.path);
  const k = Math.min(own.index, all.length - 2);
  const at = Number(((all[k].at + all[k + 1].at) / 2).toPrecision(4));
  return { edits: [insert([...own.path, k + 1], { at, contour: structuredClone(contour) })], index: k + 1 };
}

/** Returns the edits that remove a section. Of two, the other one becomes the only contour. */
export function removedSection(file, path) {
  const own = sectionOf(path);
  if (!own) return [];
  const all = valueAt(valueOf(file), own.path);
  if (all.length > 2) return [remove([...own.path, own.index])];
  return [set(own.path.slice(0, -1), all[1 - own.index].contour)];
}

/** Returns the edits that place a section at a part of the trajectory's length, between its neighbours. */
export function placedSection(file, { path, index }, at) {
  const all = valueAt(valueOf(file), path), apart = 1e-3;
  const low = index ? all[index - 1].at + apart : 0, high = index + 1 < all.length ? all[index + 1].at - apart : 1;
  const inside = Math.min(high, Math.max(low, at));
  return [set([...path, index, "at"], Number(inside.toPrecision(4)))];
}
