// The texts of the opened files, with the line of an error.

import { fileOf, known, on } from "./store.js";
import { post } from "./api.js";
import { make } from "./toolbar.js";
import { announce } from "./store.js";

/** Time without typing after which a text is sent, in milliseconds. */
const QUIET = 250;

/** Makes the editor in an element. Returns a function that shows a line of a file. */
export function textEditor(root) {
  const area = make("textarea", { spellcheck: false, wrap: "off" });
  area.setAttribute("aria-label", "Text of the file");
  const numbers = make("pre");
  numbers.setAttribute("aria-hidden", "true");
  const tabs = make("div", { className: "tools" });
  const fault = make("p", { className: "warn" });
  fault.setAttribute("role", "status");
  root.append(make("div", { className: "texts" }, tabs, make("div", { className: "writing" }, numbers, area), fault));
  let path = "", base = "", waits = 0, typed = false, gesture = "";

  function open(next) {
    if (typed) send();
    path = next;
    base = fileOf(path)?.text ?? "";
    area.value = base;
    gesture = "";
    drawTabs();
    mark();
  }

  function drawTabs() {
    tabs.replaceChildren(...known.state.files.map((file) => {
      const own = make("button", { type: "button", onclick: () => open(file.path), title: file.path });
      own.textContent = shortest(file.path) + (file.changed ? " •" : "");
      own.setAttribute("aria-pressed", file.path === path);
      return own;
    }));
  }

  /** The name of a file, with its folder if another file has the same name. */
  function shortest(name) {
    const last = name.split("/").pop();
    const same = known.state.files.filter((file) => file.path.split("/").pop() === last);
    return same.length > 1 ? name.split("/").slice(-2).join("/") : last;
  }

  /** Numbers the lines and marks the one with the error. */
  function mark() {
    const own = known.fault?.file === path ? known.fault : null;
    const count = area.value.split("\n").length;
    const rows = [];
    for (let k = 1; k <= count; k++) {
      rows.push(own?.line === k ? make("span", { className: "bad", textContent: String(k) }) : String(k), "\n");
    }
    numbers.replaceChildren(...rows);
    numbers.scrollTop = area.scrollTop;
    area.setAttribute("aria-invalid", own ? "true" : "false");
    fault.textContent = own ? `Line ${own.line}, column ${own.column}: ${own.path ? own.path + ": " : ""}${own.message}` : "";
  }

  async function send() {
    clearTimeout(waits);
    typed = false;
    const text = area.value, file = path;
    if (text === base) return;
    gesture ||= `typing-${Date.now()}`;
    try {
      await post("text", { file, text, base, gesture });
      if (file === path) base = text;
    } catch (error) {
      announce("refused", error.message);
      if (file === path) { base = fileOf(file)?.text ?? ""; area.value = base; mark(); }
    }
  }

  area.addEventListener("input", () => { typed = true; mark(); clearTimeout(waits); waits = setTimeout(send, QUIET); });
  area.addEventListener("scroll", () => { numbers.scrollTop = area.scrollTop; });
  area.addEventListener("blur", () => { if (typed) send(); gesture = ""; });

  on("state", ({ files, main }) => {
    if (!files.some((file) => file.path === path)) return open(files.some((file) => file.path === main) ? main : files[0]?.path ?? "");
    drawTabs();
    const now = fileOf(path)?.text ?? "";
    if (!typed && now !== area.value) {
      const { selectionStart, selectionEnd, scrollTop } = area;
      area.value = now;
      area.setSelectionRange(selectionStart, selectionEnd);
      area.scrollTop = scrollTop;
    }
    if (!typed) base = now;
    mark();
  });
  on("fault", mark);

  return {
    /** Shows a line of a file, from 1. */
    go(file, line) {
      if (file !== path && fileOf(file)) open(file);
      const before = area.value.split("\n").slice(0, line - 1).join("\n").length + (line > 1 ? 1 : 0);
      const end = area.value.indexOf("\n", before);
      area.focus();
      area.setSelectionRange(before, end < 0 ? area.value.length : end);
      area.scrollTop = (line - 6) * 18;
    },
  };
}
