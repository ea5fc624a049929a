// An editor of the handles of one curve on a plane: dragging, snapping, symmetry, keys and typed numbers.

import { Plane, lineThrough, svg } from "./plane.js";
import { edit, newGesture, written } from "./store.js";
import { length, minus } from "./bezier.js";
import { moved } from "./model.js";

/** Options that all editors share. */
export const options = { snap: false, mirror: false };

/**
 * The editor of one plane. `flat` maps a point of the curve to the plane, and `lift` maps a point of the plane back, near
 * an old point of the curve.
 */
export class Planar {
  constructor(label, { flat = (p) => p, lift = (p) => p, select = () => {} } = {}) {
    this.plane = new Plane(label);
    Object.assign(this, { flat, lift, select, file: "", model: { handles: [] }, chosen: null, under: () => {}, found: new Set() });
    this.plane.changed = () => this.draw();
    this.plane.pressedBackground = () => { this.choose(null); this.plane.sheet.focus({ preventScroll: true }); };
    this.drag = null;
  }

  /** Shows a curve. `under` draws behind the handles. */
  show(file, model, bounds, under) {
    this.file = file;
    this.under = under;
    if (!this.drag) this.model = model;
    if (!this.plane.isFitted || this.key !== `${file} ${written(model.path || [])} ${model.kind}`) {
      this.key = `${file} ${written(model.path || [])} ${model.kind}`;
      this.plane.isMoved = false;
      this.plane.fit(bounds);
    } else {
      this.draw();
    }
  }

  handle(id) { return this.model.handles.find((one) => one.id === id); }

  choose(id) {
    this.chosen = id;
    this.select(id);
    this.draw();
  }

  draw() {
    const { plane } = this;
    const focused = document.activeElement?.dataset?.handle;
    const had = plane.front.contains(document.activeElement);
    plane.front.replaceChildren();
    this.under(plane);
    const pixel = (p) => plane.toPixel(this.flat(p));
    for (const handle of this.model.handles) {
      if (!handle.anchor) continue;
      const [x1, y1] = pixel(handle.anchor.at), [x2, y2] = pixel(handle.at);
      svg("line", { x1, y1, x2, y2, class: "arm" }, plane.front);
    }
    for (const handle of this.model.handles) this.drawHandle(handle, pixel(handle.at));
    if (had && focused) plane.front.querySelector(`[data-handle="${focused}"]`)?.focus({ preventScroll: true });
  }

  drawHandle(handle, [x, y]) {
    const { plane } = this;
    const round = handle.role !== "anchor" || handle.smooth;
    const names = ["handle", handle.role];
    if (handle.id === this.chosen) names.push("selected");
    if (this.found.has(written(handle.path))) names.push("found");
    const at = handle.at.map((value) => plane.rounded(value)).join(", ");
    const common = {
      class: names.join(" "), tabindex: 0, role: "button", "data-handle": handle.id,
      "aria-label": `${handle.role} ${handle.id} at ${at}`,
    };
    const shape = round
      ? svg("circle", { ...common, cx: x, cy: y, r: handle.role === "control" ? 4.5 : 6 }, plane.front)
      : svg("rect", { ...common, x: x - 5.5, y: y - 5.5, width: 11, height: 11 }, plane.front);
    shape.addEventListener("pointerdown", (event) => this.press(event, handle));
    shape.addEventListener("focus", () => { if (this.chosen !== handle.id) { this.chosen = handle.id; this.select(handle.id); } });
    shape.addEventListener("keydown", (event) => this.keyed(event, handle));
  }

  press(event, handle) {
    if (event.button) return;
    event.preventDefault();
    event.stopPropagation();
    this.choose(handle.id);
    const { sheet } = this.plane;
    const mirrored = options.mirror ? this.twin(handle) : null;
    // Handles are drawn anew while they move, so that the sheet itself follows the pointer.
    this.drag = { id: handle.id, start: handle, mirrored, gesture: newGesture(), moved: false };
    sheet.setPointerCapture(event.pointerId);
    const move = (moving) => this.moveTo(this.plane.under(moving), moving);
    const end = (ending) => {
      sheet.removeEventListener("pointermove", move);
      sheet.removeEventListener("pointerup", end);
      sheet.removeEventListener("pointercancel", end);
      const { drag } = this;
      this.drag = null;
      if (drag?.moved) edit(this.file, drag.last, drag.gesture, true);
      this.handle(handle.id) && this.plane.front.querySelector(`[data-handle="${handle.id}"]`)?.focus({ preventScroll: true });
      ending.preventDefault();
    };
    sheet.addEventListener("pointermove", move);
    sheet.addEventListener("pointerup", end);
    sheet.addEventListener("pointercancel", end);
  }

  /** The anchor that mirrors a handle over the vertical axis, if there is one. */
  twin(handle) {
    const wanted = [-handle.at[0], ...handle.at.slice(1)];
    const far = 12 / this.plane.scale;
    return this.model.handles.find((one) => one !== handle && one.role === handle.role && length(minus(one.at, wanted)) < far);
  }

  /** Snaps a point of the plane to the grid, and to the coordinates of other handles. */
  snapped(point, id) {
    const { plane } = this;
    const near = 7 / plane.scale, step = plane.step() / 4;
    return point.map((x, axis) => {
      for (const other of this.model.handles) {
        const value = this.flat(other.at)[axis];
        if (other.id !== id && Math.abs(value - x) < near) return value;
      }
      return Math.round(x / step) * step;
    });
  }

  moveTo(point, event) {
    const { drag, plane } = this;
    if (!drag) return;
    // A snapped point keeps the digits of the grid and of the other handles.
    const snaps = options.snap !== !!event?.altKey;
    const short = (x) => (snaps ? Number(x.toPrecision(10)) : plane.rounded(x));
    const round = (p) => p.map(short);
    const to = round(this.lift(snaps ? this.snapped(point, drag.id) : point, drag.start.at));
    let edits = moved(drag.start, to);
    if (drag.mirrored) edits = edits.concat(moved(drag.mirrored, [-to[0], ...to.slice(1)]));
    edits = edits.map((one) => ({ ...one, value: Array.isArray(one.value) ? round(one.value) : short(one.value) }));
    drag.moved = true;
    drag.last = edits;
    edit(this.file, edits, drag.gesture, false);
    this.applied(edits);
  }

  /** Moves the handles at once, before the program answers. */
  applied(edits) {
    const values = new Map(edits.map((one) => [JSON.stringify(one.path), one.value]));
    const move = (handle) => {
      const paths = handle.paths || [handle.path];
      const value = paths.map((path) => values.get(JSON.stringify(path))).find((one) => one !== undefined);
      if (value === undefined) return handle.at;
      return Array.isArray(value) ? value : [value, 0];
    };
    const handles = this.model.handles.map((handle) => ({ ...handle, at: move(handle) }));
    const own = new Map(handles.map((one) => [one.id, one]));
    for (const handle of handles) if (handle.anchor) handle.anchor = own.get(handle.anchor.id);
    const segments = this.model.segments?.map((segment, i) => segment.map((p, j) =>
      values.get(JSON.stringify([...this.model.path, i, j])) || p));
    const points = this.model.points?.map((p, k) => values.get(JSON.stringify([...this.model.path, k])) || p);
    this.model = { ...this.model, handles, segments, points };
    this.draw();
  }

  keyed(event, handle) {
    const step = (event.shiftKey ? 10 : 1) * this.plane.step() / 20;
    const by = { ArrowLeft: [-step, 0], ArrowRight: [step, 0], ArrowUp: [0, step], ArrowDown: [0, -step] }[event.key];
    if (by) {
      event.preventDefault();
      const from = this.flat(handle.at);
      const to = this.lift([from[0] + by[0], from[1] + by[1]], handle.at);
      this.typed(handle, to);
    }
    if (event.key === "Delete" || event.key === "Backspace") { event.preventDefault(); this.deleted?.(handle); }
  }

  /** Moves a handle to a point as one step. */
  typed(handle, to) {
    const round = (p) => p.map((x) => Number(x.toPrecision(12)));
    const edits = moved(handle, round(to)).map((one) => ({ ...one, value: Array.isArray(one.value) ? round(one.value) : one.value }));
    edit(this.file, edits);
    this.applied(edits);
  }

  /** Draws a path through points of the curve's space. */
  line(points, name, closed = false) {
    const pixels = points.map((p) => this.plane.toPixel(this.flat(p)));
    return svg("path", { d: lineThrough(pixels, closed), class: name }, this.plane.front);
  }
}

/** Returns the box around points of a plane, or the unit square. */
export function boxOf(points) {
  const low = [Infinity, Infinity], high = [-Infinity, -Infinity];
  for (const p of points) for (const k of [0, 1]) { low[k] = Math.min(low[k], p[k]); high[k] = Math.max(high[k], p[k]); }
  return low[0] <= high[0] ? [low, high] : [[-1, -1], [1, 1]];
}
