// The handles of a contour or trajectory, and the edits that moving, adding and removing them means.

import { insert, remove, set } from "./store.js";
import { divided, isSmooth, length, minus, nearest, ofPath, plus, times } from "./bezier.js";

/** Returns the places of a kind of curve (contour or trajectory) in a spec, with their names. */
export function curvesOf(spec, key) {
  const found = [];
  const look = (value, path, name) => {
    if (!value || typeof value !== "object") return;
    for (const list of ["sections", "loops"]) {
      if (!Array.isArray(value[list])) continue;
      value[list].forEach((one, k) => {
        const own = list === "sections" ? [...path, list, k, "contour"] : [...path, list, k];
        const word = list === "sections" ? `section ${k + 1} at ${one.at}` : `loop ${k + 1}`;
        look(list === "sections" ? one.contour : one, own, `${name}${word}`);
      });
      return;
    }
    found.push({ value, path, name: name.replace(/: $/, "") || key });
  };
  if (Array.isArray(spec?.parts)) {
    spec.parts.forEach((part, k) => look(part[key], ["parts", k, key], `${part.name || k + 1}: `));
  } else if (spec) look(spec[key], [key], "");
  return found;
}

/** Returns the handles of a curve at a path. A handle has `at`, `path`, and `role`: anchor, control or radius. */
export function modelOf(curve, path) {
  if (!curve) return { kind: "none", handles: [] };
  if (typeof curve.circle === "number") {
    return { kind: "circle", path, handles: [{ id: "r", role: "radius", at: [curve.circle, 0], path: [...path, "circle"] }] };
  }
  if (Array.isArray(curve.line)) {
    return { kind: "line", path, handles: curve.line.map((at, k) => ({ id: `p${k}`, role: "anchor", at, path: [...path, "line", k] })) };
  }
  if (curve.bezier?.segments) return ofBezier(curve.bezier, [...path, "bezier"]);
  for (const kind of ["free", "polyline"]) {
    if (!Array.isArray(curve[kind]?.points)) continue;
    const own = [...path, kind, "points"];
    const points = curve[kind].points;
    const handles = points.map((at, k) => ({ id: `p${k}`, index: k, role: "anchor", at, path: [...own, k] }));
    return { kind, path: own, handles, closed: !!curve[kind].closed, points };
  }
  if (typeof curve.svg === "string") return { kind: "svg", path, handles: [], d: curve.svg };
  return { kind: Object.keys(curve)[0] || "none", path, handles: [] };
}

function ofBezier(bezier, path) {
  const { segments } = bezier;
  const count = segments.length, closed = !!bezier.closed, own = [...path, "segments"];
  const handles = [];
  const joints = closed ? count : count + 1;
  for (let k = 0; k < joints; k++) {
    const before = k > 0 ? k - 1 : closed ? count - 1 : null;
    const after = k < count ? k : null;
    const paths = [];
    if (before !== null) paths.push([...own, before, 3]);
    if (after !== null) paths.push([...own, after, 0]);
    const at = after !== null ? segments[after][0] : segments[before][3];
    const arms = [];
    if (before !== null) arms.push({ id: `c${before}b`, role: "control", at: segments[before][2], path: [...own, before, 2] });
    if (after !== null) arms.push({ id: `c${after}a`, role: "control", at: segments[after][1], path: [...own, after, 1] });
    const anchor = { id: `a${k}`, index: k, role: "anchor", at, path: paths[0], paths, arms, before, after };
    anchor.smooth = arms.length === 2 && isSmooth(arms[0].at, at, arms[1].at);
    for (const arm of arms) { arm.anchor = anchor; arm.other = arms.find((one) => one !== arm); }
    handles.push(...arms, anchor);
  }
  return { kind: "bezier", path: own, handles, closed, segments };
}

/** Returns the edits that move a handle to a point, as their paths and values. */
export function moved(handle, to) {
  if (handle.role === "radius") return [set(handle.path, Math.max(1e-6, length(to)))];
  if (!handle.paths && handle.role === "anchor") {
    // Numbers after the coordinates belong to the point and stay.
    return [set(handle.path, [...to, ...handle.at.slice(to.length)])];
  }
  if (handle.role === "anchor") {
    const by = minus(to, handle.at);
    return [...handle.paths.map((path) => set(path, to)),
      ...handle.arms.map((arm) => set(arm.path, plus(arm.at, by)))];
  }
  const edits = [set(handle.path, to)];
  const { anchor, other } = handle;
  if (anchor.smooth && other) {
    const out = minus(to, anchor.at), far = length(out);
    if (far > 1e-9) edits.push(set(other.path, plus(anchor.at, times(out, -length(minus(other.at, anchor.at)) / far))));
  }
  return edits;
}

/** Returns the edits that make a joint smooth or a corner. */
export function toggled(anchor) {
  if (!anchor?.arms || anchor.arms.length < 2) return [];
  const [a, b] = anchor.arms;
  const [ta, tb] = [minus(a.at, anchor.at), minus(b.at, anchor.at)];
  if (anchor.smooth) {
    // A corner: both arms point at the thirds of the way to their neighbours.
    const turn = (v) => (v.length === 2 ? [v[0] * 0.8 - v[1] * 0.6, v[0] * 0.6 + v[1] * 0.8] : times(v, 0.3));
    return [set(b.path, plus(anchor.at, turn(tb)))];
  }
  let along = minus(times(tb, 1 / Math.max(length(tb), 1e-9)), times(ta, 1 / Math.max(length(ta), 1e-9)));
  if (length(along) < 1e-9) along = tb;
  along = times(along, 1 / Math.max(length(along), 1e-9));
  const reach = (v) => Math.max(length(v), 1e-3);
  return [set(a.path, plus(anchor.at, times(along, -reach(ta)))), set(b.path, plus(anchor.at, times(along, reach(tb))))];
}

/** Returns the edits that add a point on the curve near a point. */
export function added(model, at) {
  if (model.kind === "bezier") {
    const { segment, t } = nearest(model.segments, at);
    const [first, second] = divided(model.segments[segment], t);
    return [set([...model.path, segment], first), insert([...model.path, segment + 1], second)];
  }
  if (model.points) {
    const count = model.points.length;
    const spans = model.closed ? count : count - 1;
    let best = { far: Infinity, k: 0 };
    for (let k = 0; k < spans; k++) {
      const [a, b] = [model.points[k], model.points[(k + 1) % count]].map((p) => p.slice(0, at.length));
      const ab = minus(b, a), t = Math.min(1, Math.max(0, minus(at, a).reduce((s, x, i) => s + x * ab[i], 0) / Math.max(1e-12, length(ab) ** 2)));
      const far = length(minus(at, plus(a, times(ab, t))));
      if (far < best.far) best = { far, k };
    }
    return [insert([...model.path, best.k + 1], at)];
  }
  return [];
}

/** Returns the edits that remove a point, or none if the curve needs it. */
export function removed(model, handle) {
  if (!handle || handle.role !== "anchor") return [];
  if (model.points) {
    return model.points.length > (model.closed ? 3 : 2) ? [remove(handle.path)] : [];
  }
  if (model.kind !== "bezier" || model.segments.length < 2) return [];
  const { before, after } = handle;
  if (before === null) return [remove([...model.path, 0])];
  if (after === null) return [remove([...model.path, before])];
  if (before > after) {
    const joined = [...model.segments[before].slice(0, 2), ...model.segments[after].slice(2)];
    return [set([...model.path, before], joined), remove([...model.path, after])];
  }
  const joined = [...model.segments[before].slice(0, 2), ...model.segments[after].slice(2)];
  return [set([...model.path, before], joined), remove([...model.path, after])];
}

/** Returns a contour made of an SVG path as cubics, or null if it has arcs or several subpaths. */
export function bezierOf(d) {
  const all = ofPath(d);
  if (!all || all.length !== 1) return null;
  const [{ segments, closed }] = all;
  const short = (p) => p.map((x) => Number(x.toPrecision(7)));
  return { bezier: { closed, segments: segments.map((segment) => segment.map(short)) } };
}
