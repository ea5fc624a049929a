// Graphs of the laws along the trajectory: scale, twist and the heights of a relief, with keys that can be dragged.

import { at as valueAt, edit, insert, newGesture, on, remove, set, valueOf } from "./store.js";
import { Plane, lineThrough, svg } from "./plane.js";
import { pointAt } from "./bezier.js";
import { button, fields, make } from "./toolbar.js";

/** The laws of a spec that have graphs, with their paths and their values if they are left out. */
function lawsOf(spec, path) {
  const own = valueAt(spec, path) || {};
  const each = Array.isArray(own.scale);
  const found = each
    ? [["Scale of x", [...path, "scale", 0], 1], ["Scale of y", [...path, "scale", 1], 1]]
    : [["Scale", [...path, "scale"], 1]];
  found.push(["Twist, degrees", [...path, "twist"], 0]);
  (own.depth?.terms || []).forEach((_, k) => found.push([`Relief ${k + 1}`, [...path, "depth", "terms", k, "along"], 1]));
  return found.map(([name, at, missing]) => ({ name, path: at, missing }));
}

/** Returns the points of a law that can be dragged, and the graph as points. */
function graphOf(law, missing) {
  const value = law ?? missing;
  if (typeof value === "number") return { kind: "number", keys: [[0.5, value]], line: [[0, value], [1, value]] };
  if (Array.isArray(value.keys)) {
    const { keys } = value, line = [];
    if (keys.length) line.push([0, keys[0][1]]);
    keys.forEach((key, k) => {
      const next = keys[k + 1];
      const steps = next && value.ease === "smooth" ? 24 : 1;
      for (let i = 0; i < steps; i++) {
        const t = i / steps, s = t * t * (3 - 2 * t);
        line.push(next ? [key[0] + t * (next[0] - key[0]), key[1] + s * (next[1] - key[1])] : key);
      }
    });
    if (keys.length) line.push([1, keys[keys.length - 1][1]]);
    return { kind: "keys", keys, line };
  }
  if (Array.isArray(value.bezier)) {
    const line = value.bezier.flatMap((segment) => Array.from({ length: 25 }, (_, k) => pointAt(segment, k / 24)));
    return { kind: "bezier", segments: value.bezier, keys: [], line: [[0, line[0][1]], ...line, [1, line[line.length - 1][1]]] };
  }
  if (typeof value.total === "number") return { kind: "total", keys: [[1, value.total]], line: [[0, 0], [1, value.total]] };
  return { kind: "none", keys: [], line: [] };
}

/** Returns the handles of a law: their points, and the edits that move them. */
function handlesOf(graph, path) {
  const clamp = (x) => Math.min(1, Math.max(0, x));
  if (graph.kind === "number") return [{ at: graph.keys[0], move: ([, y]) => [set(path, y)] }];
  if (graph.kind === "total") return [{ at: graph.keys[0], move: ([, y]) => [set([...path, "total"], y)] }];
  if (graph.kind === "keys") {
    return graph.keys.map((at, k) => ({
      at, key: k, move: ([x, y]) => {
        const low = k ? graph.keys[k - 1][0] + 1e-3 : 0, high = k + 1 < graph.keys.length ? graph.keys[k + 1][0] - 1e-3 : 1;
        return [set([...path, "keys", k], [Math.min(high, Math.max(low, x)), y])];
      },
    }));
  }
  return (graph.segments || []).flatMap((segment, s) => segment.map((at, k) => ({
    at, control: k === 1 || k === 2, anchorOf: segment[k === 1 ? 0 : 3],
    move: ([x, y]) => {
      const to = [clamp(x), y], edits = [set([...path, "bezier", s, k], to)];
      if (k === 0 && s > 0) edits.push(set([...path, "bezier", s - 1, 3], to));
      if (k === 3 && graph.segments[s + 1]) edits.push(set([...path, "bezier", s + 1, 0], to));
      return edits;
    },
  })).filter((_, k) => k > 0 || s === 0));
}

/** Makes the graphs in an element. `chosen` returns the path of the shown spec. */
export function lawsEditor(root, chosen) {
  const holder = make("div", { className: "graphs" });
  root.append(holder);
  let shown = "";
  let graphs = [];

  function show() {
    const spec = valueOf(chosen());
    if (!spec) return;
    const parts = Array.isArray(spec.parts) ? spec.parts.map((_, k) => ["parts", k]) : [[]];
    const laws = parts.flatMap((path) => lawsOf(spec, path).map((law) => ({
      ...law, name: path.length ? `${spec.parts[path[1]].name || path[1] + 1}: ${law.name}` : law.name,
    })));
    const key = chosen() + JSON.stringify(laws);
    if (key !== shown) {
      shown = key;
      graphs = laws.map((law) => one(law));
      holder.replaceChildren(...graphs.map((graph) => graph.element));
    }
    for (const graph of graphs) graph.show(spec);
  }

  function one({ name, path, missing }) {
    const plane = new Plane(`Graph of ${name}`);
    let graph = graphOf(undefined, missing), handles = [], picked = -1, drag = null, fitted = false;
    const numbers = fields(["at", "value"], (to) => { if (handles[picked]) edit(chosen(), handles[picked].move(to)); });
    const add = (point) => {
      const at = point.map((x) => Number(x.toPrecision(4)));
      at[0] = Math.min(1, Math.max(0, at[0]));
      if (graph.kind === "keys") {
        const k = graph.keys.filter((key) => key[0] < at[0]).length;
        if (!graph.keys.some((key) => key[0] === at[0])) edit(chosen(), [insert([...path, "keys", k], at)]);
      } else if (graph.kind === "number") {
        const value = graph.keys[0][1];
        edit(chosen(), [set(path, { keys: [[0, value], at, [1, value]].filter((key, k, all) => !k || key[0] > all[k - 1][0]), ease: "smooth" })]);
      } else if (graph.kind === "total") edit(chosen(), [set(path, { keys: [[0, 0], at, [1, graph.keys[0][1]]] })]);
    };
    const drop = () => {
      const handle = handles[picked];
      if (handle?.key !== undefined && graph.keys.length > 2) edit(chosen(), [remove([...path, "keys", handle.key])]);
    };
    const split = button("x and y apart", "Give each axis of the contour its own scale", () => {
      const value = valueAt(valueOf(chosen()), path) ?? missing;
      edit(chosen(), [set(path, [value, value])]);
    });
    split.hidden = name !== "Scale" && !name.endsWith(": Scale");
    const element = make("div", { className: "editor" },
      make("div", { className: "tools" }, make("h3", { textContent: name }),
        button("Add key", "Add a key in the middle; double-click adds one where you click", () => add([0.5, value(0.5)])),
        button("Delete", "Remove the chosen key (Del)", drop),
        button("Plain", "Back to one number", () => edit(chosen(), [remove(path)])), split, numbers.group));
    const inner = make("div", { className: "plane" });
    inner.append(plane.sheet);
    element.append(inner);
    plane.sheet.addEventListener("dblclick", (event) => { if (!event.target.closest(".handle")) add(plane.under(event)); });
    plane.changed = draw;

    function value(x) {
      const k = graph.line.findIndex((p) => p[0] >= x);
      return k < 0 ? missing : graph.line[k][1];
    }

    function fit() {
      const values = graph.line.map((p) => p[1]);
      const low = Math.min(0, ...values);
      let high = Math.max(0, ...values);
      if (high - low < 1e-9) high = low + 1;
      plane.isMoved = false;
      plane.fit([[0, low], [1, high + 0.05 * (high - low)]], true);
    }

    function draw() {
      plane.front.replaceChildren();
      svg("path", { d: lineThrough(graph.line.map((p) => plane.toPixel(p))), class: "drawn" }, plane.front);
      handles.forEach((handle, k) => {
        const [cx, cy] = plane.toPixel(handle.at);
        if (handle.control) {
          const [x2, y2] = plane.toPixel(handle.anchorOf);
          svg("line", { x1: cx, y1: cy, x2, y2, class: "arm" }, plane.front);
        }
        const dot = svg("circle", {
          cx, cy, r: handle.control ? 4.5 : 6, tabindex: 0, role: "button", "aria-label": `key at ${handle.at.join(", ")}`,
          class: `handle ${handle.control ? "control" : ""} ${k === picked ? "selected" : ""}`,
        }, plane.front);
        dot.addEventListener("pointerdown", (event) => press(event, k));
        dot.addEventListener("focus", () => { picked = k; numbers.show(handle.at); });
        dot.addEventListener("keydown", (event) => {
          const step = [0.01, 8 / (plane.scale * plane.ratio)];
          const by = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
          if (by) { event.preventDefault(); send(k, [handle.at[0] + by[0] * step[0], handle.at[1] + by[1] * step[1]], "", true); }
          if (event.key === "Delete") drop();
        });
      });
    }

    function send(k, to, gesture, ends) {
      const short = (x) => Number(x.toPrecision(4));
      const edits = handles[k].move(to).map((change) => ({
        ...change, value: Array.isArray(change.value) ? change.value.map(short) : short(change.value),
      }));
      edit(chosen(), edits, gesture, ends);
    }

    function press(event, k) {
      event.preventDefault();
      event.stopPropagation();
      picked = k;
      drag = { gesture: newGesture() };
      plane.sheet.setPointerCapture(event.pointerId);
      const move = (moving) => { drag.to = plane.under(moving); send(k, drag.to, drag.gesture, false); };
      const end = () => {
        plane.sheet.removeEventListener("pointermove", move);
        plane.sheet.removeEventListener("pointerup", end);
        if (drag.to) send(k, drag.to, drag.gesture, true);
        drag = null;
      };
      plane.sheet.addEventListener("pointermove", move);
      plane.sheet.addEventListener("pointerup", end);
      draw();
    }

    return {
      element,
      show(spec) {
        graph = graphOf(valueAt(spec, path), missing);
        handles = handlesOf(graph, path);
        numbers.show(handles[picked]?.at);
        if (!fitted && plane.size[0] > 30 && root.offsetParent) { fitted = true; fit(); } else draw();
      },
    };
  }

  on("state", show);
  return { show };
}
