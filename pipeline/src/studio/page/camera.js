// The camera of the scene, moved by mouse, touch and keyboard.

import { at as valueAt, edit, known, newGesture, set, valueOf } from "./store.js";
import { length, minus, plus, times } from "./bezier.js";

/** Time after which turning the wheel counts as ended, in milliseconds. */
const STILL = 350;

const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const unit = (a) => times(a, 1 / Math.max(length(a), 1e-12));

/** Turns a vector about a unit axis. */
function turned(v, axis, angle) {
  const c = Math.cos(angle), s = Math.sin(angle);
  const along = v.reduce((sum, x, k) => sum + x * axis[k], 0) * (1 - c);
  return plus(plus(times(v, c), times(cross(axis, v), s)), times(axis, along));
}

/** Moves the camera along its direction until it sees all curves of the opened specs, as one step. */
export function frame() {
  const camera = valueAt(valueOf(known.state.scene), ["camera"]);
  const points = Object.values(known.curves.specs).flat().flatMap((part) => part.stations.flat());
  if (!camera || !points.length) return;
  const [low, high] = [Math.min, Math.max].map((of) => [0, 1, 2].map((axis) => points.reduce((x, p) => of(x, p[axis]), points[0][axis])));
  const middle = times(plus(low, high), 0.5);
  const radius = Math.max(...points.map((p) => length(minus(p, middle))), 1e-9);
  const direction = unit(minus(camera.eye, camera.target));
  const far = camera.height !== undefined ? length(minus(camera.eye, camera.target))
    : (1.05 * radius) / Math.sin(((camera.fov_deg ?? 40) * Math.PI) / 360);
  const digits = Math.min(12, Math.max(0, Math.ceil(4 - Math.log10(far))));
  const short = (p) => p.map((x) => Number(x.toFixed(digits)));
  const edits = [set(["camera", "eye"], short(plus(middle, times(direction, far)))), set(["camera", "target"], short(middle))];
  if (camera.height !== undefined) edits.push(set(["camera", "height"], Number((2.1 * radius).toPrecision(4))));
  edit(known.state.scene, edits);
}

/** Lets an element move the camera. `click` gets the position of a press without a movement, in [0, 1]. */
export function moveCamera(stage, click) {
  let gesture = null, still = 0, local = null;
  const touched = new Set();
  const pointers = new Map();

  const stored = () => valueAt(valueOf(known.state.scene), ["camera"]);
  const camera = () => local || stored();

  function change(next, ends = false) {
    const now = camera();
    if (!now) return;
    gesture ??= newGesture();
    local = { ...now, ...next };
    Object.keys(next).forEach((key) => touched.add(key));
    // Values that the gesture does not change keep their digits.
    const keys = ends ? [...touched] : Object.keys(next);
    edit(known.state.scene, keys.map((key) => set(["camera", key], rounded(key, local[key]))), gesture, ends);
    if (ends) { gesture = null; local = null; touched.clear(); }
  }

  const rounded = (key, value) => {
    const far = length(minus(camera().eye, camera().target)) || 1;
    const digits = Math.max(0, Math.ceil(4 - Math.log10(far)));
    const short = (x) => Number(x.toFixed(Math.min(12, digits)));
    if (key === "fov_deg") return Number(value.toFixed(2));
    return Array.isArray(value) ? value.map(short) : short(value);
  };

  const end = () => { if (gesture) change({}, true); };

  function orbit(dx, dy) {
    const { eye, target, up = [0, 1, 0] } = camera();
    const axis = unit(up);
    let arm = turned(minus(eye, target), axis, -dx);
    const side = unit(cross(axis, arm));
    const next = turned(arm, side, -dy);
    // The view never passes over the pole, where up would lie along it.
    if (length(cross(unit(next), axis)) > 0.02) arm = next;
    change({ eye: plus(target, arm) });
  }

  function pan(dx, dy) {
    const { eye, target, up = [0, 1, 0], fov_deg, height } = camera();
    const forward = minus(target, eye), far = length(forward);
    const right = unit(cross(forward, up)), top = unit(cross(right, forward));
    const tall = height ?? 2 * far * Math.tan(((fov_deg ?? 40) * Math.PI) / 360);
    const by = plus(times(right, -dx * tall), times(top, dy * tall));
    change({ eye: plus(eye, by), target: plus(target, by) });
  }

  function dolly(factor) {
    const { eye, target, height } = camera();
    if (height !== undefined) change({ height: height / factor });
    else change({ eye: plus(target, times(minus(eye, target), 1 / factor)) });
  }

  function focal(factor) {
    const { eye, target, fov_deg } = camera();
    if (fov_deg === undefined) return;
    const half = Math.tan((fov_deg * Math.PI) / 360);
    const wide = Math.min(120, Math.max(2, (360 / Math.PI) * Math.atan(half / factor)));
    // The object keeps its size: the eye moves as the angle changes.
    const ratio = half / Math.tan((wide * Math.PI) / 360);
    change({ fov_deg: wide, eye: plus(target, times(minus(eye, target), ratio)) });
  }

  const tall = () => stage.clientHeight || 1;

  stage.addEventListener("pointerdown", (event) => {
    stage.focus({ preventScroll: true });
    stage.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, { at: [event.clientX, event.clientY], from: [event.clientX, event.clientY], moved: false });
    event.preventDefault();
  });
  stage.addEventListener("pointermove", (event) => {
    const own = pointers.get(event.pointerId);
    if (!own || !camera()) return;
    const now = [event.clientX, event.clientY];
    const [dx, dy] = minus(now, own.at);
    if (!own.moved && length(minus(now, own.from)) < 4) return;
    own.moved = true;
    if (pointers.size === 2) {
      const other = [...pointers].find(([id]) => id !== event.pointerId)[1];
      const far = (p) => Math.max(1, length(minus(p, other.at)));
      pan(dx / tall() / 2, dy / tall() / 2);
      dolly(far(now) / far(own.at));
    } else if (event.shiftKey || event.buttons & 6) pan(dx / tall(), dy / tall());
    else if (event.altKey) focal(Math.exp(-dy / 200));
    else orbit((dx / tall()) * Math.PI, (dy / tall()) * Math.PI);
    own.at = now;
  });
  for (const name of ["pointerup", "pointercancel"]) {
    stage.addEventListener(name, (event) => {
      const own = pointers.get(event.pointerId);
      pointers.delete(event.pointerId);
      if (own && !own.moved && name === "pointerup") {
        const box = stage.getBoundingClientRect();
        click([(event.clientX - box.left) / box.width, (event.clientY - box.top) / box.height]);
      }
      if (!pointers.size) end();
    });
  }
  stage.addEventListener("contextmenu", (event) => event.preventDefault());
  const later = () => { clearTimeout(still); still = setTimeout(end, STILL); };
  stage.addEventListener("wheel", (event) => {
    event.preventDefault();
    if (!camera()) return;
    const factor = Math.exp(-event.deltaY * 0.0012);
    if (event.ctrlKey || event.altKey) focal(factor); else dolly(factor);
    later();
  }, { passive: false });
  stage.addEventListener("keydown", (event) => {
    if (!camera() || event.ctrlKey || event.metaKey) return;
    const step = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
    if (step && event.shiftKey) pan(step[0] * 0.04, step[1] * 0.04);
    else if (step) orbit(step[0] * 0.08, step[1] * 0.08);
    else if (event.key === "+" || event.key === "=") dolly(1.08);
    else if (event.key === "-") dolly(1 / 1.08);
    else if (event.key === "]") focal(1.08);
    else if (event.key === "[") focal(1 / 1.08);
    else if (event.key === "f") return frame();
    else return;
    event.preventDefault();
    later();
  });
  return { end };
}
