// The findings of both checks with their remedies, and the measures of each mesh.

import { fileOf, known, on } from "./store.js";
import { lineOf } from "./positions.js";
import { make } from "./toolbar.js";

const ORDER = { wrong: 0, hint: 1, remark: 2 };

/** Returns all findings, the most severe first. */
export function allFindings() {
  const specs = (known["spec-check"]?.specs || []).flatMap((one) => one.findings);
  const scene = known["scene-check"]?.findings || [];
  return [...specs, ...scene].sort((a, b) => ORDER[a.severity] - ORDER[b.severity]);
}

/** Makes the list in an element. `go` shows a line of a file, and `control` a control of a path. */
export function findingsList(root, tab, go, control) {
  const holder = make("div");
  holder.setAttribute("aria-live", "polite");
  root.append(holder);
  let text = "";

  function show() {
    const all = allFindings(), fault = known.fault;
    const specs = known["spec-check"]?.specs || [];
    const key = JSON.stringify([all, fault, specs.map((one) => one.measures)]);
    if (key === text) return;
    text = key;
    const severe = all.filter((one) => one.severity !== "remark").length + (fault ? 1 : 0);
    tab.textContent = severe ? `Findings (${severe})` : "Findings";
    const items = [];
    if (fault) items.push(item({ severity: "wrong", file: fault.file, path: fault.path || "", message: fault.message }));
    items.push(...all.map(item));
    if (!items.length) items.push(make("p", { className: "good", textContent: "Both checks find nothing to remark." }));
    items.push(...specs.map(measures));
    holder.replaceChildren(...items);
  }

  function item(finding) {
    const box = make("div", { className: `finding ${finding.severity}-level` });
    const where = make("span", { className: "hint", textContent: `${finding.file?.split("/").pop() ?? ""} ${finding.path}` });
    box.append(make("div", { className: "row" }, make("strong", { textContent: finding.severity }), where,
      make("span", { className: "grow" })));
    const file = finding.file && fileOf(finding.file);
    if (file) {
      box.firstChild.append(
        make("button", { type: "button", textContent: "Control", onclick: () => control(finding.file, finding.path) }),
        make("button", { type: "button", textContent: "Line", onclick: () => go(finding.file, lineOf(file.text, finding.path)) }));
    }
    box.append(make("div", { textContent: finding.message }));
    return box;
  }

  function measures({ name, measures: own }) {
    const unit = own.unit ? ` ${own.unit}` : "";
    const short = (x) => Number(x.toPrecision(4));
    const rows = [
      ["closes", own.closes, own.watertight ? "good" : "warn"],
      ["box", `${own.size.map(short).join(" × ")}${unit}`],
      ["area", `${short(own.area)}${unit && unit + "²"}`],
      ["volume", own.volume === null ? "none, the surface encloses none" : `${short(own.volume)}${unit && unit + "³"}`],
      ["Euler number", own.euler], ["sides", own.sides], ["rims", own.rims],
      ["mesh", `${own.vertices} vertices, ${own.triangles} triangles`],
    ];
    const table = make("table", { className: "measures" });
    table.append(make("caption", { className: "hint", textContent: `Measures of ${name}` }));
    for (const [word, value, className = ""] of rows) {
      const head = make("th", { textContent: word });
      head.scope = "row";
      table.append(make("tr", {}, head, make("td", { textContent: value, className })));
    }
    return table;
  }

  for (const name of ["spec-check", "scene-check", "fault"]) on(name, show);
}
