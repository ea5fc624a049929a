// Joins the parts of the page.

import { get, listen, post } from "./api.js";
import { announce, ask, known, on } from "./store.js";
import { frame } from "./camera.js";
import { contourEditor } from "./contour.js";
import { exportsPanel } from "./exports.js";
import { findingsList } from "./findings.js";
import { lawsEditor } from "./laws.js";
import { addPart } from "./parts.js";
import { choosePicture, putOn } from "./pictures.js";
import { picture } from "./picture.js";
import { schemaForm } from "./form.js";
import { showStart } from "./start.js";
import { tabs } from "./tabs.js";
import { textEditor } from "./text.js";
import { trajectoryEditor } from "./trajectory.js";

const element = (id) => document.getElementById(id);
const spec = element("spec");
const chosenSpec = () => spec.value || known.state.specs?.[0]?.path || "";

picture();
const contour = contourEditor(element("contour"), chosenSpec);
const trajectory = trajectoryEditor(element("trajectory"), chosenSpec);
const laws = lawsEditor(element("laws"), chosenSpec);
const specForm = schemaForm(element("spec-form"), chosenSpec, get("schema/spec"), ["contour"]);
const sceneForm = schemaForm(element("scene-form"), () => known.state.scene || "", get("schema/scene"));
const text = textEditor(element("text"));
exportsPanel(element("export"));
const panes = {
  curves: tabs(element("curves"), { contour: contour.show, trajectory: trajectory.show, laws: laws.show }),
  details: tabs(element("details"), { "spec-form": () => specForm.show(true), "scene-form": () => sceneForm.show(true) }),
};

const go = (file, line) => { panes.details("text"); text.go(file, line); };
const control = (file, path) => {
  const isScene = file === known.state.scene;
  if (!isScene && known.state.specs.some((one) => one.path === file)) { spec.value = file; showSpec(); }
  panes.details(isScene ? "scene-form" : "spec-form");
  (isScene ? sceneForm : specForm).go(path);
};
findingsList(element("findings"), element("tab-findings"), go, control);

function showSpec() { for (const one of [contour, trajectory, laws, specForm]) one.show(); }
spec.addEventListener("change", showSpec);
const meshOf = (path) => known.state.specs?.find((one) => one.path === path)?.name;
element("add-picture").addEventListener("click", () => choosePicture((file) => putOn(meshOf(chosenSpec()), file)));
for (const name of ["dragover", "dragleave", "drop"]) {
  element("stage").addEventListener(name, (event) => { event.preventDefault(); element("stage").classList.toggle("dropping", name === "dragover"); });
}
element("stage").addEventListener("drop", (event) => { const [file] = event.dataTransfer.files; if (file) putOn(meshOf(chosenSpec()), file); });
element("add-part").addEventListener("click", async () => {
  const path = chosenSpec(), before = known.curves.specs[path]?.length;
  await addPart(path);
  // A scene of the program shows the new part too, once its curve is known.
  wantsFrame = known.state.files.some((file) => file.path === known.state.scene && file.new) ? { path, before } : null;
});
let wantsFrame = null;
on("curves", ({ specs }) => {
  if (!wantsFrame || specs[wantsFrame.path]?.length === wantsFrame.before) return;
  wantsFrame = null;
  frame();
});

let isOpen = null;
on("state", (state) => {
  const open = !!state.main;
  if (!open) { if (isOpen !== false) showStart(); isOpen = false; return; }
  if (isOpen !== state.main) {
    isOpen = state.main;
    element("start").hidden = true;
    element("studio").hidden = false;
    element("curves").hidden = !state.specs.length;
    element("tab-spec-form").hidden = !state.specs.length;
    queueMicrotask(showSpec);
  }
  const paths = [...new Set(state.specs.map((one) => one.path))];
  if ([...spec.options].map((one) => one.value).join() !== paths.join()) {
    spec.replaceChildren(...state.specs.filter((one, k) => paths.indexOf(one.path) === state.specs.findIndex((other) => other.path === one.path) || k < 0)
      .filter((one, k, all) => all.findIndex((other) => other.path === one.path) === k)
      .map((one) => Object.assign(document.createElement("option"), { value: one.path, textContent: one.name })));
  }
  spec.parentElement.hidden = paths.length < 2;
  element("file-name").textContent = state.main;
  document.title = `${state.main.split("/").pop()} · Topobook studio`;
  const changed = state.files.filter((file) => file.changed);
  element("changed").textContent = changed.length ? `${changed.length} not saved` : "saved";
  element("save").disabled = !changed.length;
  element("undo").disabled = !state.undo;
  element("redo").disabled = !state.redo;
  conflicts(state.files.filter((file) => file.conflict !== null));
});

/** Shows both texts of a file that another program changed. */
function conflicts(files) {
  const box = element("conflict");
  box.hidden = !files.length;
  box.replaceChildren(...files.flatMap((file) => {
    const own = (word, mine) => Object.assign(document.createElement("button"), {
      type: "button", textContent: word, onclick: () => ask("settle", { file: file.path, mine }),
    });
    const line = document.createElement("div");
    line.append(`Another program changed ${file.path}, which has changes here too. `,
      own("Keep mine", true), " ", own("Take theirs (can be undone)", false));
    const theirs = Object.assign(document.createElement("pre"), { textContent: file.conflict });
    return [line, theirs];
  }));
}

element("undo").addEventListener("click", () => ask("step", "undo"));
element("redo").addEventListener("click", () => ask("step", "redo"));
element("save").addEventListener("click", () => ask("save", {}));
element("save-as").addEventListener("click", () => {
  const file = known.state.main, dialog = element("copy"), name = element("copy-name");
  element("copy-of").textContent = `A copy of ${file} is written and opened.`;
  name.value = file.replace(/\.json$/, "-2.json");
  dialog.returnValue = "";
  dialog.onclose = () => { if (dialog.returnValue === "save" && name.value !== file) ask("save", { file, to: name.value }); };
  dialog.showModal();
  name.select();
});
element("home").addEventListener("click", () => {
  const lost = known.state.files.some((file) => file.changed && !file.new);
  if (!lost || confirm("Changes that are not saved are lost. Go to the start page?")) ask("close", {});
});
document.addEventListener("keydown", (event) => {
  if (!(event.ctrlKey || event.metaKey)) return;
  const key = event.key.toLowerCase();
  const typing = document.activeElement?.tagName === "TEXTAREA";
  if (key === "s") { event.preventDefault(); ask("save", {}); }
  if (key === "z" && !typing) { event.preventDefault(); ask("step", event.shiftKey ? "redo" : "undo"); }
  if (key === "y" && !typing) { event.preventDefault(); ask("step", "redo"); }
});
addEventListener("beforeunload", (event) => {
  if (isLost && known.state.files.some((file) => file.changed)) event.preventDefault();
});

const notice = element("notice");
let noticeEnds = 0, isLost = false, instance = null;
function say(words, lasts = 6000) {
  clearTimeout(noticeEnds);
  notice.textContent = words;
  notice.hidden = !words;
  if (words && lasts) noticeEnds = setTimeout(() => { notice.hidden = true; }, lasts);
}
on("refused", (words) => say(words));

/** Time after which a file that was opened anew is announced, in milliseconds. */
const RESTORED = 400;

/** Gives a program that was started anew the texts that only this window still has. */
async function restore(files) {
  for (const file of files.filter((one) => one.changed)) {
    const now = known.state.files.find((one) => one.path === file.path);
    if (now && now.text !== file.text) {
      try { await post("text", { file: file.path, text: file.text, base: now.text }); } catch (error) { say(error.message); }
    }
  }
}

const NAMES = ["hello", "state", "picture", "beside", "progress", "fault", "curves", "spec-check", "scene-check"];
listen(NAMES, async (name, value) => {
  if (name !== "hello") {
    announce(name, value);
    return;
  }
  const isNew = instance && instance !== value.instance;
  instance = value.instance;
  if (isNew && known.state.main) {
    // The program was killed and started again: its files are whole, and its memory is empty.
    const { files, main } = known.state;
    await ask("open", { name: main });
    setTimeout(() => restore(files), RESTORED);
  }
}, (connected) => {
  if (!connected && !isLost) say("The program does not answer. All files are whole; the texts of this page stay here until it runs again.", 0);
  if (connected && isLost) say("The program answers again.");
  isLost = !connected;
});

// Before a file is opened no state is announced.
setTimeout(() => { if (isOpen === null) { isOpen = false; showStart(); } }, 300);
