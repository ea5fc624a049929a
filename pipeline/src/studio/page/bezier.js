// Cubic Bezier segments with any number of coordinates.

export const mix = (a, b, t) => a.map((x, k) => x + (b[k] - x) * t);
export const minus = (a, b) => a.map((x, k) => x - b[k]);
export const plus = (a, b) => a.map((x, k) => x + b[k]);
export const times = (a, s) => a.map((x) => x * s);
export const length = (a) => Math.hypot(...a);

/** Returns the point of a segment at `t` in [0, 1]. */
export function pointAt([a, b, c, d], t) {
  const [ab, bc, cd] = [mix(a, b, t), mix(b, c, t), mix(c, d, t)];
  return mix(mix(ab, bc, t), mix(bc, cd, t), t);
}

/** Divides a segment at `t` into two, by de Casteljau's algorithm. */
export function divided([a, b, c, d], t) {
  const [ab, bc, cd] = [mix(a, b, t), mix(b, c, t), mix(c, d, t)];
  const [abc, bcd] = [mix(ab, bc, t), mix(bc, cd, t)];
  const middle = mix(abc, bcd, t);
  return [[a, ab, abc, middle], [middle, bcd, cd, d]];
}

/** Returns the index and the `t` of the point of segments nearest to a point. */
export function nearest(segments, point) {
  let best = { far: Infinity, segment: 0, t: 0 };
  segments.forEach((segment, index) => {
    for (let k = 1; k < 40; k++) {
      const far = length(minus(pointAt(segment, k / 40), point));
      if (far < best.far) best = { far, segment: index, t: k / 40 };
    }
  });
  return best;
}

/** Returns whether the controls on both sides of a joint are on one line through it. */
export function isSmooth(before, joint, after) {
  const [a, b] = [minus(before, joint), minus(after, joint)];
  const [la, lb] = [length(a), length(b)];
  if (la < 1e-9 || lb < 1e-9) return false;
  const cosine = a.reduce((sum, x, k) => sum + x * b[k], 0) / (la * lb);
  return cosine < -0.9995;
}

/**
 * Reads the `d` of an SVG path as cubics, one list for each subpath, with y pointing up. Arcs are not read: the result is
 * null.
 */
export function ofPath(d) {
  const words = d.match(/[a-zA-Z]|[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?/g) || [];
  const all = [];
  let at = [0, 0], start = [0, 0], segments = null, command = "", last = null, k = 0;
  const number = () => Number(words[k++]);
  const pair = (relative) => { const x = number(), y = number(); return relative ? [at[0] + x, at[1] + y] : [x, y]; };
  const line = (to) => segments.push([at, mix(at, to, 1 / 3), mix(at, to, 2 / 3), to]);
  while (k < words.length) {
    if (/[a-zA-Z]/.test(words[k])) command = words[k++];
    const relative = command === command.toLowerCase(), kind = command.toUpperCase();
    let control = null;
    if (kind === "M") {
      at = pair(relative); start = at; segments = []; all.push({ segments, closed: false });
      command = relative ? "l" : "L";
    } else if (!segments) {
      return null;
    } else if (kind === "Z") {
      if (length(minus(at, start)) > 1e-9) line(start);
      at = start; all[all.length - 1].closed = true;
    } else if (kind === "L") { const to = pair(relative); line(to); at = to; }
    else if (kind === "H") { const to = [number() + (relative ? at[0] : 0), at[1]]; line(to); at = to; }
    else if (kind === "V") { const to = [at[0], number() + (relative ? at[1] : 0)]; line(to); at = to; }
    else if (kind === "C" || kind === "S") {
      const first = kind === "C" ? pair(relative) : last ? minus(times(at, 2), last) : at;
      control = pair(relative);
      const to = pair(relative);
      segments.push([at, first, control, to]); at = to;
    } else if (kind === "Q") {
      const middle = pair(relative), to = pair(relative);
      segments.push([at, mix(at, middle, 2 / 3), mix(to, middle, 2 / 3), to]); at = to;
    } else return null;
    last = control;
  }
  const up = (p) => [p[0], -p[1]];
  return all.map((one) => ({ ...one, segments: one.segments.map((segment) => segment.map(up)) }))
    .filter((one) => one.segments.length);
}
