// Exports, and the commands that make the same files.

import { ask, known, on } from "./store.js";
import { make } from "./toolbar.js";

const FORMATS = [
  ["png", "PNG picture"], ["exr", "EXR picture"], ["obj", "OBJ mesh"], ["stl", "STL mesh"], ["ply", "PLY mesh"],
  ["glb", "GLB mesh"], ["3mf", "3MF mesh"],
];

/** Makes the panel in an element. */
export function exportsPanel(root) {
  const format = make("select");
  format.append(...FORMATS.map(([value, textContent]) => make("option", { value, textContent })));
  const mesh = make("select");
  const path = make("input", { type: "text", size: 30, required: true });
  const go = make("button", { type: "submit", className: "main", textContent: "Export" });
  const result = make("div");
  result.setAttribute("aria-live", "polite");
  const meshLabel = make("label", {}, "Mesh ", mesh);
  const form = make("form", { className: "form" },
    make("div", { className: "tools" }, make("label", {}, "Format ", format), meshLabel, make("label", {}, "File ", path), go));
  root.append(form,
    make("p", { className: "hint", textContent: "Changed files are saved first, since the commands read the saved files. The picture has the size and the error that are chosen below the picture." }),
    result);

  const isPicture = () => ["png", "exr"].includes(format.value);
  function propose() {
    meshLabel.hidden = isPicture();
    const stem = (isPicture() ? known.state.job : mesh.value || "mesh")?.split("/").pop().replace(/(-job)?\.json$/, "") || "picture";
    path.value = `out/${stem}.${format.value}`;
  }
  format.addEventListener("change", propose);
  mesh.addEventListener("change", propose);

  on("state", ({ specs, main }) => {
    const names = (specs || []).map((one) => one.name);
    if ([...mesh.options].map((one) => one.value).join() !== names.join() || root.dataset.main !== main) {
      root.dataset.main = main;
      mesh.replaceChildren(...names.map((name) => make("option", { value: name, textContent: name })));
      propose();
      result.replaceChildren();
    }
  });

  form.addEventListener("submit", async (event) => {
    event.preventDefault();
    go.disabled = true;
    result.replaceChildren(make("p", { className: "hint", textContent: "Working…" }));
    const saved = await ask("save", {});
    const done = saved && await ask("export", { path: path.value, mesh: mesh.value });
    go.disabled = false;
    if (!done) return result.replaceChildren();
    const text = done.commands.join("\n");
    const copy = make("button", { type: "button", textContent: "Copy", onclick: () => navigator.clipboard?.writeText(text) });
    result.replaceChildren(
      make("p", { textContent: `${done.path} is written, ${done.bytes.toLocaleString("en")} bytes. The same bytes by command lines in the opened folder:` }),
      make("pre", { className: "commands", textContent: text }), copy);
  });
}
