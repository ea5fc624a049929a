// The editor of a trajectory: an orbit view and three orthographic views, with frames and stations.

import { edit, known, on, set, valueOf } from "./store.js";
import { added, curvesOf, modelOf, moved, removed, toggled } from "./model.js";
import { Planar, boxOf } from "./planar.js";
import { minus, plus, pointAt, times } from "./bezier.js";
import { drawMarks } from "./marks.js";
import { button, fields, make, toggle } from "./toolbar.js";

const VIEWS = [
  { name: "orbit", title: "Orbit" }, { name: "front", title: "Front (x, y)", axes: [0, 1] },
  { name: "side", title: "Side (z, y)", axes: [2, 1] }, { name: "top", title: "Top (x, -z)", axes: [0, 2], down: true },
];

/** Makes the editor in an element. `chosen` returns the path of the shown spec. */
export function trajectoryEditor(root, chosen) {
  const orbit = { turn: -0.6, lift: 0.45 };
  let index = 0;
  const which = make("select", { onchange: () => { index = which.selectedIndex; fitted = ""; show(); } });
  which.setAttribute("aria-label", "Part whose trajectory is shown");
  let selected = null;
  const numbers = fields(["x", "y", "z"], (at) => {
    const handle = current();
    if (handle) edit(views[0].file, moved(handle, at));
  });
  const right = () => [Math.cos(orbit.turn), 0, -Math.sin(orbit.turn)];
  const up = () => [-Math.sin(orbit.turn) * Math.sin(orbit.lift), Math.cos(orbit.lift), -Math.cos(orbit.turn) * Math.sin(orbit.lift)];
  const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const views = VIEWS.map(({ name, title, axes, down }) => {
    const flat = axes
      ? (p) => [p[axes[0]], down ? -p[axes[1]] : p[axes[1]]]
      : (p) => [dot(p, right()), dot(p, up())];
    const lift = axes
      ? (q, near) => near.slice(0, 3).map((x, k) => (k === axes[0] ? q[0] : k === axes[1] ? (down ? -q[1] : q[1]) : x))
      : (q, near) => {
        const was = flat(near), by = [q[0] - was[0], q[1] - was[1]];
        return plus(near.slice(0, 3), plus(times(right(), by[0]), times(up(), by[1])));
      };
    const view = new Planar(`Trajectory, ${title}`, { flat, lift, select: (id) => chooseIn(view, id) });
    view.title = title;
    if (name === "orbit") {
      view.plane.turned = (dx, dy) => {
        orbit.turn += dx * 0.01;
        orbit.lift = Math.min(1.55, Math.max(-1.55, orbit.lift + dy * 0.01));
        view.plane.draw();
      };
    }
    view.deleted = (handle) => apply(removed(view.model, handle));
    return view;
  });
  const current = () => views[0].model.handles.find((one) => one.id === selected);
  const apply = (edits) => { if (edits.length) edit(views[0].file, edits); };
  const note = make("span", { className: "hint" });
  const insertButton = button("Insert", "Add a point after the chosen one", () => {
    const { model } = views[0], k = current()?.index ?? 0;
    if (model.segments) apply(added(model, pointAt(model.segments[Math.min(k, model.segments.length - 1)], 0.5)));
    else if (model.points) {
      const a = model.points[k], b = model.points[(k + 1) % model.points.length];
      apply(added(model, [0, 1, 2].map((i) => (a[i] + b[i]) / 2)));
    }
  });
  const deleteButton = button("Delete", "Remove the chosen point (Del)", () => current() && apply(removed(views[0].model, current())));
  const smoothButton = button("Smooth", "Make the chosen joint smooth or a corner", () => apply(toggled(current()?.anchor || current())));
  const kinds = make("select", { onchange: () => convert(kinds.value) });
  kinds.setAttribute("aria-label", "Kind of trajectory");
  for (const kind of ["rotation", "line", "circle", "helix", "bezier", "free", "polyline", "other"]) {
    kinds.append(make("option", { value: kind, textContent: { bezier: "Bezier", free: "free points" }[kind] || kind }));
  }
  root.append(make("div", { className: "editor" },
    make("div", { className: "tools" }, kinds, which, insertButton, deleteButton, smoothButton,
      toggle("Snap", "Snap to the grid and to other handles", "snap"),
      button("Fit", "Show the whole trajectory", fit), numbers.group, note),
    make("div", { className: "four" }, ...views.map((view) => {
      const holder = make("div");
      holder.append(view.plane.sheet);
      return holder;
    }))));

  const places = () => curvesOf(valueOf(chosen()), "trajectory");
  const place = () => places()[Math.min(index, places().length - 1)] || { path: ["trajectory"] };
  const parts = () => known.curves.specs[chosen()] || [];
  const space = () => {
    const points = parts().flatMap((part) => [...part.course, ...part.stations.flat()]);
    return points.length ? points : views[0].model.handles.map((one) => one.at);
  };

  function fit() {
    for (const view of views) { view.plane.isMoved = false; view.plane.fit(boxOf(space().map(view.flat))); }
  }

  function chooseIn(view, id) {
    selected = id;
    for (const other of views) if (other !== view && other.chosen !== id) { other.chosen = id; other.draw(); }
    follow();
  }

  let fitted = "";

  function show() {
    const one = place();
    if (one.value === undefined || !root.offsetParent) return;
    const all = places();
    if ([...which.options].map((option) => option.textContent).join() !== all.map((other) => other.name).join()) {
      which.replaceChildren(...all.map((other) => make("option", { textContent: other.name })));
      index = Math.min(index, all.length - 1);
      which.selectedIndex = index;
    }
    which.hidden = all.length < 2;
    const model = modelOf(one.value, one.path);
    kinds.value = [...kinds.options].some((option) => option.value === model.kind) ? model.kind : "other";
    for (const view of views) {
      if (!view.drag) view.model = model;
      view.show(chosen(), model, boxOf(space().map(view.flat)), () => under(view));
    }
    // The sampled curves come after the text, and only then the size is known.
    const key = chosen() + model.kind + (parts().length > 0);
    if (key !== fitted) { fitted = key; fit(); }
    follow();
  }

  function under(view) {
    for (const part of parts()) {
      for (const station of part.stations) view.line(station, "station", part.closed);
      view.line(part.course, "drawn");
      const size = Math.max(...minus(...extent(part.course))) || 1;
      for (const [origin, normal, binormal] of part.frames) {
        view.line([origin, plus(origin, times(normal, 0.07 * size))], "w1");
        view.line([origin, plus(origin, times(binormal, 0.07 * size))], "w2");
      }
    }
    const { plane } = view;
    const text = document.createElementNS("http://www.w3.org/2000/svg", "text");
    text.setAttribute("x", plane.size[0] - 8);
    text.setAttribute("y", 16);
    text.setAttribute("text-anchor", "end");
    text.textContent = view.title;
    plane.front.append(text);
    drawMarks(plane, chosen(), parts(), (p) => plane.toPixel(view.flat(p)));
  }

  const extent = (points) => {
    const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
    for (const p of points) for (const k of [0, 1, 2]) { low[k] = Math.min(low[k], p[k]); high[k] = Math.max(high[k], p[k]); }
    return [high, low];
  };

  function follow() {
    const handle = current(), { model } = views[0];
    numbers.show(handle?.at);
    insertButton.disabled = !(model.segments || model.points);
    deleteButton.disabled = !handle || !removed(model, handle).length;
    const joint = handle?.anchor || handle;
    smoothButton.disabled = !(joint?.arms?.length === 2);
    smoothButton.textContent = joint?.smooth ? "Corner" : "Smooth";
    note.textContent = ["rotation", "circle", "helix"].includes(model.kind) ? "Numbers of this curve are under Surface." : "";
  }

  /** Replaces the trajectory by one of another kind, through points of the present one. */
  function convert(kind) {
    const course = parts()[0]?.course || [[0, 0, 0], [0, 1, 0]];
    const last = course.length - 1;
    const short = (p) => p.map((x) => Number(x.toPrecision(5)));
    const of = (count) => Array.from({ length: count }, (_, k) => short(course[Math.round((k * last) / (count - 1))]));
    const far = Math.hypot(...minus(course[last], course[0])) > 1e-6;
    const ends = far ? [short(course[0]), short(course[last])] : [[0, 0, 0], [0, 1, 0]];
    const values = {
      rotation: { rotation: { angle_deg: 360 } },
      line: { line: ends },
      circle: { circle: { radius: 1 } },
      helix: { helix: { radius: 1, rise: 0.5, turns: 3 } },
      bezier: { bezier: { segments: [[ends[0], ...of(4).slice(1, 3), ends[1]]] } },
      free: { free: { points: far ? of(5) : [[0, 0, 0], [0.3, 0.5, 0], [0, 1, 0]] } },
      polyline: { polyline: { points: far ? of(4) : [[0, 0, 0], [0.3, 0.5, 0], [0, 1, 0]], corners: "mitre" } },
    };
    if (values[kind]) { edit(chosen(), [set(place().path, values[kind])]); for (const view of views) view.plane.isFitted = false; }
    else show();
  }

  on("state", show);
  on("curves", show);
  return { show };
}
