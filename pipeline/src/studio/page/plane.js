// A plane with a grid on an SVG element: the map between its points and pixels, panning and zooming.

const NS = "http://www.w3.org/2000/svg";

/** Makes an SVG element with attributes. */
export function svg(name, attributes = {}, parent = null) {
  const element = document.createElementNS(NS, name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  if (parent) parent.append(element);
  return element;
}

/** A plane of which a part is seen. y points up. */
export class Plane {
  constructor(label) {
    this.sheet = svg("svg", { class: "sheet", role: "group", "aria-label": label, tabindex: 0 });
    this.back = svg("g", {}, this.sheet);
    this.front = svg("g", {}, this.sheet);
    this.middle = [0, 0];
    this.scale = 100;
    this.ratio = 1;
    this.isFitted = false;
    this.changed = () => {};
    this.pressedBackground = null;
    this.pointers = new Map();
    new ResizeObserver(() => this.resized()).observe(this.sheet);
    this.sheet.addEventListener("wheel", (event) => this.wheel(event), { passive: false });
    this.sheet.addEventListener("pointerdown", (event) => this.down(event));
    this.sheet.addEventListener("pointermove", (event) => this.move(event));
    for (const end of ["pointerup", "pointercancel"]) {
      this.sheet.addEventListener(end, (event) => this.pointers.delete(event.pointerId));
    }
    this.sheet.addEventListener("keydown", (event) => {
      if (event.target !== this.sheet) return;
      const step = { ArrowLeft: [-40, 0], ArrowRight: [40, 0], ArrowUp: [0, -40], ArrowDown: [0, 40] }[event.key];
      if (step) { this.pan(-step[0], -step[1]); event.preventDefault(); }
      if (event.key === "+" || event.key === "=") this.zoom(1.2, this.centre());
      if (event.key === "-") this.zoom(1 / 1.2, this.centre());
      if (event.key === "0") this.fit(this.bounds || [[-1, -1], [1, 1]]);
    });
  }

  get size() { return [this.sheet.clientWidth || 300, this.sheet.clientHeight || 200]; }
  centre() { const [w, h] = this.size; return [w / 2, h / 2]; }

  toPixel([x, y]) {
    const [w, h] = this.size;
    return [w / 2 + (x - this.middle[0]) * this.scale, h / 2 - (y - this.middle[1]) * this.scale * this.ratio];
  }

  toPlane([x, y]) {
    const [w, h] = this.size;
    return [this.middle[0] + (x - w / 2) / this.scale, this.middle[1] - (y - h / 2) / (this.scale * this.ratio)];
  }

  /** The point of the plane under a pointer. */
  under(event) {
    const box = this.sheet.getBoundingClientRect();
    return this.toPlane([event.clientX - box.left, event.clientY - box.top]);
  }

  /** Shows a box of the plane with a margin. `free` stretches the axes by themselves. */
  fit([low, high], free = false) {
    this.bounds = [low, high];
    this.free = free;
    const [w, h] = this.size;
    if (w < 20 || h < 20) return;
    const wide = Math.max(high[0] - low[0], 1e-9), tall = Math.max(high[1] - low[1], 1e-9);
    const across = (w - 56) / wide, up = (h - 48) / tall;
    this.scale = free ? across : Math.max(1e-6, Math.min(across, up));
    this.ratio = free ? up / across : 1;
    this.middle = [(low[0] + high[0]) / 2, (low[1] + high[1]) / 2];
    this.isFitted = true;
    this.draw();
  }

  resized() { if (this.bounds && !this.isMoved) this.fit(this.bounds, this.free); else this.draw(); }

  pan(dx, dy) {
    this.isMoved = true;
    this.middle = [this.middle[0] - dx / this.scale, this.middle[1] + dy / (this.scale * this.ratio)];
    this.draw();
  }

  zoom(factor, [x, y]) {
    this.isMoved = true;
    const before = this.toPlane([x, y]);
    this.scale = Math.min(1e9, Math.max(1e-6, this.scale * factor));
    const after = this.toPlane([x, y]);
    this.middle = [this.middle[0] + before[0] - after[0], this.middle[1] + before[1] - after[1]];
    this.draw();
  }

  wheel(event) {
    event.preventDefault();
    const box = this.sheet.getBoundingClientRect();
    this.zoom(Math.exp(-event.deltaY * 0.0015), [event.clientX - box.left, event.clientY - box.top]);
  }

  down(event) {
    if (event.target.closest(".handle, .hit")) return;
    this.pointers.set(event.pointerId, [event.clientX, event.clientY]);
    this.sheet.setPointerCapture(event.pointerId);
    this.pressedBackground?.(event);
  }

  move(event) {
    const old = this.pointers.get(event.pointerId);
    if (!old) return;
    const now = [event.clientX, event.clientY];
    if (this.pointers.size === 2) {
      const other = [...this.pointers].find(([id]) => id !== event.pointerId)[1];
      const far = (p) => Math.hypot(p[0] - other[0], p[1] - other[1]);
      const box = this.sheet.getBoundingClientRect();
      this.zoom(far(now) / Math.max(1, far(old)), [other[0] - box.left, other[1] - box.top]);
    } else if (this.turned) {
      this.turned(now[0] - old[0], now[1] - old[1]);
    } else {
      this.pan(now[0] - old[0], now[1] - old[1]);
    }
    this.pointers.set(event.pointerId, now);
  }

  /** The step of the grid: 1, 2 or 5 times a power of ten, at least 40 pixels. */
  step(scale = this.scale) {
    const least = 40 / scale, power = 10 ** Math.floor(Math.log10(least));
    return [1, 2, 5, 10].map((k) => k * power).find((step) => step >= least) || 10 * power;
  }

  /** Rounds a number to what a pixel shows. */
  rounded(x, scale = this.scale) {
    const digits = Math.min(12, Math.max(0, Math.ceil(Math.log10(scale))));
    return Number(x.toFixed(digits));
  }

  draw() {
    const [w, h] = this.size;
    this.back.replaceChildren();
    const low = this.toPlane([0, h]), high = this.toPlane([w, 0]);
    const steps = [this.step(), this.step(this.scale * this.ratio)];
    for (const axis of [0, 1]) {
      const step = steps[axis];
      for (let k = Math.ceil(low[axis] / step); k * step <= high[axis]; k++) {
        const value = k * step, pixel = this.toPixel(axis ? [0, value] : [value, 0])[axis];
        const line = axis ? { x1: 0, x2: w, y1: pixel, y2: pixel } : { y1: 0, y2: h, x1: pixel, x2: pixel };
        svg("line", { ...line, class: k === 0 ? "axis" : "grid" }, this.back);
        // A label at the border would be cut, and one in the corner would lie on another.
        if (axis ? pixel < 14 || pixel > h - 16 : pixel > w - 28) continue;
        const label = svg("text", axis ? { x: 4, y: pixel - 3 } : { x: pixel + 3, y: h - 5 }, this.back);
        label.textContent = Number(value.toPrecision(6));
      }
    }
    this.changed();
  }
}

/** Returns the `d` of a path through points in pixels. */
export const lineThrough = (points, closed = false) =>
  points.length ? "M" + points.map(([x, y]) => `${x.toFixed(1)} ${y.toFixed(1)}`).join("L") + (closed ? "Z" : "") : "";
