// The marks of sections on a trajectory: a diamond for each, which moves along the curve.

import { edit, newGesture, valueOf } from "./store.js";
import { placedSection, sectionsOf } from "./sections.js";
import { svg } from "./plane.js";

/** Step of an arrow key, as a part of the trajectory's length. */
const STEP = 0.01;

/**
 * Draws the sections of all parts on a view of the trajectory. `parts` are the sampled curves of the file, and `line` maps a
 * point of a curve to pixels.
 */
export function drawMarks(plane, file, parts, line) {
  const spec = valueOf(file);
  parts.forEach((part, k) => {
    const sections = sectionsOf(spec, k);
    if (!sections || part.course.length < 2) return;
    const course = part.course.map(line), last = course.length - 1;
    sections.all.forEach(({ at }, index) => {
      const [x, y] = course[Math.round(Math.min(1, Math.max(0, at)) * last)];
      const mark = svg("path", {
        d: `M${x} ${y - 8}L${x + 8} ${y}L${x} ${y + 8}L${x - 8} ${y}Z`, class: "handle section", tabindex: 0, role: "slider",
        "aria-label": `section ${index + 1}`, "aria-valuemin": 0, "aria-valuemax": 1, "aria-valuenow": at,
        "data-handle": `section-${k}-${index}`,
      }, plane.front);
      const place = (to, gesture, ends) => edit(file, placedSection(file, { path: sections.path, index }, to), gesture, ends);
      mark.addEventListener("keydown", (event) => {
        const by = { ArrowLeft: -STEP, ArrowDown: -STEP, ArrowRight: STEP, ArrowUp: STEP }[event.key];
        if (!by) return;
        event.preventDefault();
        place(at + by, "", true);
      });
      mark.addEventListener("pointerdown", (event) => {
        event.preventDefault();
        event.stopPropagation();
        mark.focus({ preventScroll: true });
        const gesture = newGesture();
        let to = null;
        plane.sheet.setPointerCapture(event.pointerId);
        const move = (moving) => {
          const box = plane.sheet.getBoundingClientRect(), p = [moving.clientX - box.left, moving.clientY - box.top];
          const far = course.map((q) => Math.hypot(q[0] - p[0], q[1] - p[1]));
          to = far.indexOf(Math.min(...far)) / last;
          place(to, gesture, false);
        };
        const end = () => {
          for (const name of ["pointermove", "pointerup", "pointercancel"]) plane.sheet.removeEventListener(name, name === "pointermove" ? move : end);
          if (to !== null) place(to, gesture, true);
        };
        plane.sheet.addEventListener("pointermove", move);
        plane.sheet.addEventListener("pointerup", end);
        plane.sheet.addEventListener("pointercancel", end);
      });
    });
  });
}
