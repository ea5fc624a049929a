// The picture: its steps, its error, the method beside it, and the trees of its pixels.

import { pictureAddress } from "./api.js";
import { ask, known, on } from "./store.js";
import { frame, moveCamera } from "./camera.js";

const element = (id) => document.getElementById(id);

/** Starts the picture. */
export function picture() {
  const stage = element("stage"), shown = element("shown"), beside = element("beside");
  const divider = element("divider"), place = element("divider-at"), progress = element("progress");
  const statement = element("statement"), inspect = element("inspect");
  const selects = { error: element("error"), method: element("method"), size: element("size") };
  let latest = 0, fraction = 0.5, pixel = [0.5, 0.5];

  /** Shows a picture once it is decoded, so that nothing flickers. */
  async function put(image, facts) {
    const next = new Image();
    next.src = pictureAddress(facts.id);
    try { await next.decode(); } catch { return false; }
    if (image === shown && facts.id < latest) return false;
    if (image === shown) latest = facts.id;
    image.src = next.src;
    image.classList.toggle("pixels", facts.step !== "draft" && facts.size[0] > stage.clientWidth * 2);
    image.hidden = false;
    return true;
  }

  on("picture", async (facts) => {
    if (!facts) return;
    const sent = performance.now();
    if (!(await put(shown, facts))) return;
    stage.dataset.step = facts.step;
    stage.dataset.revision = facts.revision;
    document.dispatchEvent(new CustomEvent("picture-shown", { detail: { ...facts, sent } }));
    if (facts.statement) {
      const { error, bound, missed } = facts.statement;
      statement.replaceChildren("Error ", bold(error.toPrecision(2)), `, below ${bound.toPrecision(2)} with 95 % confidence, `,
        `after ${(facts.milliseconds / 1000).toFixed(1)} s`, missed ? "; the requested error was not reached" : "");
      statement.title = facts.statement.text;
    } else if (facts.step === "whole") {
      statement.textContent = known.state.view?.error ? "Measuring the error…" : `One ray per pixel, after ${(facts.milliseconds / 1000).toFixed(2)} s. No error was requested.`;
    } else {
      statement.textContent = "Draft; the error is not known yet.";
    }
  });
  const bold = (text) => Object.assign(document.createElement("strong"), { textContent: text });

  on("beside", (facts) => { if (facts && known.state.view?.beside) put(beside, facts).then(divide); });

  on("progress", (facts) => {
    const runs = facts && facts.step !== "done" && facts.total;
    progress.hidden = !runs;
    if (runs) progress.value = facts.done / facts.total;
  });

  on("fault", (fault) => {
    const line = element("fault");
    line.hidden = !fault;
    if (fault) line.textContent = fault.file ? `${fault.file}:${fault.line}:${fault.column}: ${fault.path ? fault.path + ": " : ""}${fault.message}` : fault.message;
  });

  on("state", ({ view }) => {
    if (!view) return;
    selects.error.value = view.error ?? "";
    selects.method.value = view.beside ?? "";
    if ([...selects.size.options].some((one) => one.value === String(view.size[1]))) selects.size.value = view.size[1];
    stage.style.aspectRatio = `${view.size[0]} / ${view.size[1]}`;
    if (!view.beside) beside.hidden = true;
    divide();
  });

  const send = () => ask("view", {
    size: [Number(selects.size.value), Number(selects.size.value)],
    error: selects.error.value ? Number(selects.error.value) : null,
    beside: selects.method.value || null,
  });
  for (const select of Object.values(selects)) select.addEventListener("change", send);

  /** Shows the picture of the other method to the right of the divider. */
  function divide() {
    const is = !beside.hidden && !!known.state.view?.beside;
    divider.hidden = !is;
    place.hidden = !is;
    beside.style.clipPath = `inset(0 0 0 ${100 * fraction}%)`;
    divider.style.left = `${100 * fraction}%`;
  }
  place.addEventListener("input", () => { fraction = place.value / 1000; divide(); });
  // Near the divider the pointer moves it, before the camera hears of the press.
  stage.addEventListener("pointerdown", (event) => {
    const box = stage.getBoundingClientRect();
    if (divider.hidden || Math.abs(event.clientX - box.left - fraction * box.width) > 12) return;
    event.stopImmediatePropagation();
    stage.setPointerCapture(event.pointerId);
    const move = (moving) => {
      fraction = Math.min(1, Math.max(0, (moving.clientX - box.left) / box.width));
      place.value = 1000 * fraction;
      divide();
    };
    const end = () => { stage.removeEventListener("pointermove", move); stage.removeEventListener("pointerup", end); };
    stage.addEventListener("pointermove", move);
    stage.addEventListener("pointerup", end);
  });

  element("frame").addEventListener("click", frame);
  inspect.addEventListener("change", () => { stage.classList.toggle("inspecting", inspect.checked); if (!inspect.checked) closePixel(); });
  moveCamera(stage, (at) => { if (inspect.checked) look(at); });
  stage.addEventListener("keydown", (event) => {
    if (event.key === "Enter") { inspect.checked = true; look(pixel); }
    if (event.key === "Escape") closePixel();
  });

  function closePixel() { element("pixel").hidden = true; element("cross").hidden = true; }
  element("pixel-close").addEventListener("click", closePixel);

  /** Shows the intersection tree of a pixel. */
  async function look([x, y]) {
    pixel = [x, y];
    const [width, height] = known.state.view.size;
    const at = { x: Math.min(width - 1, Math.floor(x * width)), y: Math.min(height - 1, Math.floor(y * height)) };
    const cross = element("cross");
    cross.hidden = false;
    cross.style.left = `${100 * x}%`;
    cross.style.top = `${100 * y}%`;
    element("pixel").hidden = false;
    element("pixel-title").textContent = `Pixel ${at.x}, ${at.y}`;
    element("pixel-text").textContent = "…";
    const answer = await ask("pixel", at);
    element("pixel-text").textContent = answer?.text ?? "The picture has changed.";
    element("pixel").scrollIntoView({ block: "nearest" });
  }
}
