// Another part for a spec: a tube from one point of the object to another, such as a handle.

import { ask, fileOf, known, valueOf } from "./store.js";

/** Adds a part to a spec. A spec of one sweep becomes the first part of an object. */
export async function addPart(path) {
  const file = fileOf(path), spec = valueOf(path);
  if (!file || !spec) return;
  const several = Array.isArray(spec.parts);
  const part = tube(spec, several ? spec.parts.length + 1 : 2, path);
  if (several) {
    const at = ["parts", spec.parts.length];
    await ask("edit", { file: path, edits: [{ do: "insert", path: at, value: part }] });
    return;
  }
  const indent = (text) => text.trim().split("\n").map((line) => `    ${line}`).join("\n");
  const name = JSON.stringify(spec.name ?? "object");
  const lines = Object.entries(part).map(([key, value]) => `  ${JSON.stringify(key)}: ${spaced(value)}`);
  const own = `{\n${lines.join(",\n")}\n}`;
  // The unit of an object stands beside its parts.
  const unit = spec.unit ? `, "unit": ${JSON.stringify(spec.unit)}` : "";
  const body = file.text.replace(/"unit"\s*:\s*"[^"]*"\s*,?/, "").replace(/"name"\s*:\s*"[^"]*"/, `"name": ${JSON.stringify(`${spec.name}-body`)}`);
  const text = `{\n  "format": "tb-sweep", "version": 1, "name": ${name}${unit},\n  "parts": [\n${indent(body)},\n${indent(own)}\n  ]\n}\n`;
  await ask("text", { file: path, text, base: file.text });
}

const spaced = (value) => JSON.stringify(value).replace(/([,:])/g, "$1 ");

/** A tube beside the object: from the lower third of its right side to the upper third. */
function tube(spec, number, path) {
  const points = (known.curves.specs[path] || []).flatMap((part) => part.stations.flat());
  const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
  for (const p of points) for (const k of [0, 1, 2]) { low[k] = Math.min(low[k], p[k]); high[k] = Math.max(high[k], p[k]); }
  if (!points.length) { low.fill(-1); high.fill(1); }
  const short = (x) => Number(x.toPrecision(3));
  const tall = high[1] - low[1], y = [0.3, 0.75].map((part) => low[1] + part * tall);
  // The right side of the surface at a height: its farthest point there.
  const side = (height) => Math.max(...points.filter((p) => Math.abs(p[1] - height) < 0.06 * tall).map((p) => p[0]), 0.1 * (high[0] - low[0]));
  const [a, b] = y.map((height) => [short(0.97 * side(height)), short(height), 0]);
  const out = short(high[0] + 0.3 * tall);
  const controls = [[out, a[1], 0], [out, b[1], 0]];
  return {
    name: `${spec.name ?? "part"}-${number}`,
    contour: { circle: short(0.04 * tall) },
    trajectory: { bezier: { segments: [[a, ...controls, b]] } },
    mesh: { rows: 48, cols: 24 },
  };
}
