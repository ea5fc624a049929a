// The editor of a contour: Bezier handles, free points, polyline, circle, and dropped SVG files.

import { edit, known, on, set, valueOf, at as valueAt, written } from "./store.js";
import { added, bezierOf, curvesOf, modelOf, removed, toggled } from "./model.js";
import { Planar, boxOf } from "./planar.js";
import { pointAt } from "./bezier.js";
import { lineThrough, svg } from "./plane.js";
import { addedSection, placedSection, removedSection, sectionOf } from "./sections.js";
import { button, fields, make, toggle } from "./toolbar.js";

const CIRCLE = 0.5522847498;

/** Makes the editor in an element. `chosen` returns the path of the shown spec. */
export function contourEditor(root, chosen) {
  let index = 0;
  const numbers = fields(["x", "y"], (at) => { const handle = planar.handle(planar.chosen); if (handle) planar.typed(handle, at); });
  const planar = new Planar("Contour. Tab moves between handles, arrow keys move one, Delete removes it.", {
    select: () => follow(),
  });
  const which = make("select", { onchange: () => { index = which.selectedIndex; planar.plane.isFitted = false; show(); } });
  which.setAttribute("aria-label", "Part of the contour");
  const note = make("span", { className: "hint" });
  const apply = (edits) => { if (edits.length) edit(planar.file, edits); };
  const current = () => planar.handle(planar.chosen);
  const insertAt = (point) => apply(added(planar.model, point.map((x) => planar.plane.rounded(x))));
  planar.deleted = (handle) => { planar.chosen = null; apply(removed(planar.model, handle)); };
  const insertButton = button("Insert", "Add a point after the chosen one, or in the middle of the curve", () => {
    const { model } = planar;
    const k = current()?.index ?? 0;
    if (model.segments) insertAt(pointAt(model.segments[Math.min(k, model.segments.length - 1)], 0.5));
    else if (model.points) {
      const a = model.points[k], b = model.points[(k + 1) % model.points.length];
      insertAt([(a[0] + b[0]) / 2, (a[1] + b[1]) / 2]);
    }
  });
  const deleteButton = button("Delete", "Remove the chosen point (Del)", () => current() && planar.deleted(current()));
  const smoothButton = button("Smooth", "Make the chosen joint smooth or a corner", () => apply(toggled(current()?.anchor || current())));
  const kinds = make("select", { onchange: () => { convert(kinds.value); } });
  kinds.setAttribute("aria-label", "Kind of contour");
  for (const kind of ["bezier", "free", "polyline", "circle", "svg", "other"]) {
    kinds.append(make("option", { value: kind, textContent: { bezier: "Bezier", free: "free points", svg: "SVG path" }[kind] || kind }));
  }
  const addSection = button("Add section", "Add a contour further along the trajectory, between this one and the next", () => {
    const one = place(), { edits, index: next } = addedSection(planar.file, one.path, one.value);
    const before = places().findIndex((other) => sectionOf(other.path) && written(other.path.slice(0, -2)) === written(sectionOf(one.path)?.path || []));
    index = (before < 0 ? index : before) + next;
    planar.plane.isFitted = false;
    apply(edits);
  });
  const removeSection = button("Remove section", "Remove this contour; the others blend without it", () => {
    const edits = removedSection(planar.file, place().path);
    index = Math.max(0, index - 1);
    planar.plane.isFitted = false;
    apply(edits);
  });
  const along = fields(["at"], ([at]) => { const own = sectionOf(place().path); if (own) apply(placedSection(planar.file, own, at)); }, "of the section, part of the trajectory");
  const tools = make("div", { className: "tools" }, kinds, which, along.group, insertButton, deleteButton, smoothButton,
    toggle("Snap", "Snap to the grid and to other handles; Alt does it once", "snap"),
    toggle("Mirror", "Move the mirror image of a handle with it", "mirror"),
    button("Fit", "Show the whole contour (0)", () => { planar.plane.isMoved = false; planar.plane.fit(box()); }),
    addSection, removeSection, numbers.group, note);
  const holder = make("div", { className: "plane" });
  holder.append(planar.plane.sheet);
  root.append(make("div", { className: "editor" }, tools, holder));
  planar.plane.sheet.addEventListener("dblclick", (event) => {
    if (!event.target.closest(".handle")) insertAt(planar.plane.under(event));
  });

  for (const name of ["dragover", "dragleave", "drop"]) {
    root.addEventListener(name, (event) => { event.preventDefault(); root.classList.toggle("dropping", name === "dragover"); });
  }
  root.addEventListener("drop", async (event) => {
    const file = event.dataTransfer.files[0];
    if (file) dropped(await file.text());
  });

  /** Takes the first path of an SVG file, scaled to the size of the present contour. */
  function dropped(text) {
    const d = new DOMParser().parseFromString(text, "image/svg+xml").querySelector("path")?.getAttribute("d");
    if (!d) { note.textContent = "The file has no path."; return; }
    const value = bezierOf(d) || { svg: d };
    planar.plane.isFitted = false;
    edit(planar.file, [set(place().path, value)]);
  }

  const places = () => curvesOf(valueOf(chosen()), "contour");
  const place = () => places()[Math.min(index, places().length - 1)] || { path: ["contour"] };
  const drawn = () => known.curves.specs[chosen()] || [];

  function sampled() {
    const { path } = place();
    const part = path[0] === "parts" ? path[1] : 0;
    return drawn()[part] || drawn()[0];
  }

  function box() {
    const own = planar.model.handles.map((one) => one.at);
    const curve = sampled();
    const points = own.length ? own : (curve?.contours || []).flat();
    const radius = planar.model.kind === "circle" ? own[0][0] : 0;
    return boxOf([...points, [0, 0], ...(radius ? [[-radius, -radius], [radius, radius]] : [])]);
  }

  function show() {
    const file = chosen(), all = places();
    if (which.length !== all.length || [...which.options].some((one, k) => one.textContent !== all[k].name)) {
      which.replaceChildren(...all.map((one) => make("option", { textContent: one.name })));
      index = Math.min(index, Math.max(0, all.length - 1));
      which.selectedIndex = index;
    }
    which.hidden = all.length < 2;
    const one = place();
    if (one.value === undefined || !root.offsetParent) return;
    const model = modelOf(one.value, one.path);
    kinds.value = [...kinds.options].some((option) => option.value === model.kind) ? model.kind : "other";
    if (!planar.drag) planar.model = model;
    planar.show(file, model, box(), (plane) => under(plane));
    follow();
  }

  /** Draws the curve: from its handles where they define it, or from the points that the program sampled. */
  function under(plane) {
    const { model } = planar;
    const pixel = (p) => plane.toPixel(p).map((x) => x.toFixed(1)).join(" ");
    for (const contour of sampled()?.contours || []) {
      const line = lineThrough(contour.map((p) => plane.toPixel(p)), sampled().closed);
      svg("path", { d: line, class: model.segments || model.kind === "circle" ? "drawn other" : "drawn" }, plane.front);
    }
    if (sampled()?.rotation) {
      const [x] = plane.toPixel([0, 0]), [, h] = plane.size;
      svg("line", { x1: x, x2: x, y1: 0, y2: h, class: "dashed" }, plane.front);
    }
    let d = "";
    if (model.segments) {
      d = `M${pixel(model.segments[0][0])}` + model.segments.map(([, b, c, e]) => `C${pixel(b)} ${pixel(c)} ${pixel(e)}`).join("");
    } else if (model.kind === "polyline") d = lineThrough(model.points.map((p) => plane.toPixel(p)), model.closed);
    else if (model.kind === "circle") {
      const r = model.handles[0].at[0], k = r * CIRCLE;
      d = `M${pixel([r, 0])}C${pixel([r, k])} ${pixel([k, r])} ${pixel([0, r])}C${pixel([-k, r])} ${pixel([-r, k])} ${pixel([-r, 0])}` +
        `C${pixel([-r, -k])} ${pixel([-k, -r])} ${pixel([0, -r])}C${pixel([k, -r])} ${pixel([r, -k])} ${pixel([r, 0])}`;
    }
    if (d) svg("path", { d, class: "drawn" }, plane.front);
    if (d && (model.segments || model.points)) svg("path", { d, class: "hit" }, plane.front);
  }

  function follow() {
    const handle = current();
    numbers.show(handle?.at);
    const own = sectionOf(place().path);
    removeSection.hidden = !own;
    along.group.hidden = !own;
    along.show(own ? [valueAt(valueOf(planar.file), [...own.path, own.index, "at"]) ?? 0] : null);
    const { model } = planar;
    insertButton.disabled = !(model.segments || model.points);
    deleteButton.disabled = !handle || handle.role !== "anchor" || !removed(model, handle).length;
    const joint = handle?.anchor || handle;
    smoothButton.disabled = !(joint?.arms?.length === 2);
    smoothButton.textContent = joint?.smooth ? "Corner" : "Smooth";
    note.textContent = model.kind === "svg" ? "Choose Bezier to edit the path." : "";
  }

  /** Turns the contour into another kind of curve, through points of the present one. */
  function convert(kind) {
    const one = place(), { model } = planar;
    const closed = sampled()?.closed ?? true;
    const points = model.points?.map((p) => p.slice(0, 2))
      || model.handles.filter((handle) => handle.role === "anchor").map((handle) => handle.at);
    const line = sampled()?.contours[0] || [];
    const every = line.filter((_, k) => k % Math.ceil(line.length / 10) === 0).map((p) => p.map((x) => planar.plane.rounded(x)));
    const through = points.length > 2 ? points : every;
    let value = null;
    if (kind === "circle") value = { circle: Number(Math.max(...line.map((p) => Math.hypot(...p)), 1e-3).toPrecision(4)) };
    if (kind === "polyline" || kind === "free") value = { [kind]: { closed, points: through } };
    if (kind === "bezier") {
      if (model.kind === "svg") value = bezierOf(model.d);
      else if (model.kind === "circle") {
        const r = model.handles[0].at[0], k = Number((r * CIRCLE).toPrecision(6));
        value = { bezier: { closed: true, segments: [
          [[r, 0], [r, k], [k, r], [0, r]], [[0, r], [-k, r], [-r, k], [-r, 0]],
          [[-r, 0], [-r, -k], [-k, -r], [0, -r]], [[0, -r], [k, -r], [r, -k], [r, 0]]] } };
      } else if (through.length > 1) value = { bezier: { closed, segments: smoothThrough(through, closed) } };
    }
    if (value) edit(planar.file, [set(one.path, value)]);
    else { note.textContent = "This contour has no such form."; show(); }
  }

  on("state", show);
  on("curves", show);
  return { show, planar, value: () => valueAt(valueOf(chosen()), place().path) };
}

/** Returns cubics through points whose tangents are parallel to the chords of their neighbours. */
function smoothThrough(points, closed) {
  const count = points.length, at = (k) => points[closed ? (k + count) % count : Math.min(count - 1, Math.max(0, k))];
  const tangent = (k) => [0, 1].map((i) => (at(k + 1)[i] - at(k - 1)[i]) / 6);
  const short = (p) => p.map((x) => Number(x.toPrecision(6)));
  return Array.from({ length: closed ? count : count - 1 }, (_, k) => {
    const [a, b, ta, tb] = [at(k), at(k + 1), tangent(k), tangent(k + 1)];
    return [a, short([a[0] + ta[0], a[1] + ta[1]]), short([b[0] - tb[0], b[1] - tb[1]]), b];
  });
}
