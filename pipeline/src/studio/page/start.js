// The start page: a new file, the files of the folder, and the built-in pages.

import { get } from "./api.js";
import { ask } from "./store.js";
import { make } from "./toolbar.js";

/** Shows the start page. */
export async function showStart() {
  document.getElementById("start").hidden = false;
  document.getElementById("studio").hidden = true;
  document.title = "Topobook studio";
  const { folder, files, pages } = await get("start");
  document.getElementById("start-folder").textContent = folder || "the folder";
  const choice = (path, name, note) => make("li", {},
    make("button", { type: "button", onclick: () => ask(path, { name }) }, name, make("span", { className: "hint", textContent: note })));
  document.getElementById("start-files").replaceChildren(
    ...(files.length ? files.map((file) => choice("open", file.path, file.kind)) : [make("li", { className: "hint", textContent: "There are no files yet." })]));
  document.getElementById("start-pages").replaceChildren(...pages.map((page) => choice("copy", page.name, page.title)));
}

document.getElementById("new-form").addEventListener("submit", (event) => {
  event.preventDefault();
  ask("new", { name: document.getElementById("new-name").value });
});
