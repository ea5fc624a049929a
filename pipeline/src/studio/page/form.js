// Forms made from a JSON Schema: a control for each value, with its range and its help.

import { at as valueAt, edit, insert, known, on, remove, set, valueOf, written } from "./store.js";
import { allFindings } from "./findings.js";
import { colorControls, hexOf, isColor } from "./colors.js";
import { choosePicture, upload } from "./pictures.js";
import { suggested } from "./starts.js";
import { button, make } from "./toolbar.js";

/** Keys that have editors of their own, or that nobody changes by hand. */
const ELSEWHERE = new Set(["format", "version", "$schema"]);

/** Makes the form of a file in an element. `chosen` returns its path; `schema` is a promise of its schema. */
export function schemaForm(root, chosen, schema, hidden = []) {
  const form = make("div", { className: "form" });
  const filter = make("input", { type: "search", placeholder: "Find a setting" });
  filter.setAttribute("aria-label", "Find a setting");
  root.append(filter, form);
  let whole = null, shown = null;
  const opened = new Set();
  schema.then((value) => { whole = value; show(true); });

  /** Follows references, and merges what a schema and its parts say. */
  function resolved(node) {
    let own = node || {};
    for (let k = 0; k < 20 && own.$ref; k++) {
      const { $ref, ...rest } = own;
      own = { ...whole.$defs[$ref.split("/").pop()], ...rest };
    }
    for (const part of own.allOf || []) {
      const below = resolved(part);
      const required = [...(below.required || []), ...(own.required || [])];
      own = { ...below, ...own, required, properties: { ...below.properties, ...own.properties } };
    }
    return own;
  }

  function rootSchema(value) {
    const part = value?.parts || value?.format === "tb-scene-part" ? whole.then : whole.else;
    return resolved(part);
  }

  function show(force = false) {
    const file = chosen(), value = valueOf(file);
    if (!whole || value === undefined || !root.offsetParent) return;
    // The shape of the form changes only when keys come or go; otherwise its controls are filled.
    const shape = file + JSON.stringify(value, (key, inner) => (typeof inner === "number" ? 0 : typeof inner === "string" ? "" : inner));
    if (force || shape !== shown) {
      shown = shape;
      const focus = document.activeElement?.dataset?.path;
      form.replaceChildren(...object(rootSchema(value), [], value, 0));
      if (focus) form.querySelector(`[data-path="${CSS.escape(focus)}"]`)?.focus({ preventScroll: true });
      search();
    } else fill(value);
    mark();
  }

  function fill(value) {
    for (const control of form.querySelectorAll("[data-color]")) control.value = hexOf(valueAt(value, JSON.parse(control.dataset.color)));
    for (const control of form.querySelectorAll("[data-path]")) {
      if (control === document.activeElement && control.type !== "checkbox") continue;
      const own = valueAt(value, JSON.parse(control.dataset.path));
      if (control.type === "checkbox") control.checked = !!own;
      else if (own !== undefined && typeof own !== "object") control.value = own;
    }
  }

  /** Marks the controls with findings, and says what they are. */
  function mark() {
    for (const old of form.querySelectorAll(".found")) old.remove();
    for (const old of form.querySelectorAll(".wrongly")) old.classList.remove("wrongly");
    const all = [...allFindings()];
    if (known.fault?.file) all.push({ ...known.fault, severity: "wrong" });
    for (const finding of all.filter((one) => one.file === chosen() && one.path)) {
      const field = nearest(finding.path);
      if (!field) continue;
      if (finding.severity === "wrong") field.classList.add("wrongly");
      field.append(make("p", { className: `found ${finding.severity}`, textContent: `${finding.severity}: ${finding.message}` }));
    }
  }

  function nearest(path) {
    for (let own = path; own; own = own.replace(/(\.[^.[]+|\[\d+\]|^[^.[]+)$/, "")) {
      const field = form.querySelector(`[data-field="${CSS.escape(own)}"]`);
      if (field) return field;
    }
    return null;
  }

  function search() {
    const word = filter.value.trim().toLowerCase();
    for (const field of form.querySelectorAll(".field, details")) {
      field.hidden = !!word && !field.textContent.toLowerCase().includes(word);
      if (word && field.tagName === "DETAILS" && !field.hidden) field.open = true;
    }
  }
  filter.addEventListener("input", search);

  function object(schema, path, value, depth) {
    const others = formsOf(schema), required = schema.required || [];
    const keys = Object.keys(schema.properties || {})
      .filter((key) => !(depth === 0 && (ELSEWHERE.has(key) || hidden.includes(key))))
      .filter((key) => !others.includes(key) || value?.[key] !== undefined);
    const rows = keys.map((key) =>
      field(key, resolved(schema.properties[key]), [...path, key], value?.[key], depth, !required.includes(key) && !others.includes(key)));
    return others.length ? [formChoice(schema, others, path, value), ...rows] : rows;
  }

  /** Returns the keys of an object of which exactly one is given, such as the kinds of a trajectory. */
  function formsOf(schema) {
    const all = schema.properties ? schema.oneOf || [] : [];
    return all.every((one) => one.required?.length === 1) ? all.map((one) => one.required[0]) : [];
  }

  function formChoice(schema, others, path, value) {
    const now = others.find((key) => value?.[key] !== undefined);
    const choose = make("select", { onchange: () => {
      const next = { ...value };
      delete next[now];
      next[choose.value] = started(schema.properties[choose.value], [...path, choose.value]);
      edit(chosen(), [set(path, next)]);
    } });
    choose.setAttribute("aria-label", `Form of ${written(path)}`);
    if (!now) choose.append(make("option", { value: "", textContent: "left out", disabled: true, selected: true }));
    choose.append(...others.map((key) => make("option", { value: key, textContent: key, selected: key === now })));
    return make("div", { className: "field" }, make("span", { className: "name", textContent: "form" }), make("div", { className: "value" }, choose));
  }

  function field(name, schema, path, value, depth, optional) {
    const help = (schema.description || "").replace(/\s+/g, " ");
    const kind = kindOf(schema, value);
    const compound = ["object", "list", "map", "variant"].includes(kind);
    const word = /^\d+$/.test(name) ? `Remove element ${name}` : `Remove ${name}`;
    const clear = optional && value !== undefined
      ? button(compound ? word : "×", `Leave ${name} out`, () => edit(chosen(), [remove(path)]), "quiet") : null;
    clear?.setAttribute("aria-label", word);
    if (compound) {
      const id = written(path);
      const box = make("details", { open: opened.has(id) });
      box.dataset.field = id;
      box.ontoggle = () => {
        if (box.open) opened.add(id); else opened.delete(id);
        if (box.open && !box.dataset.filled) { box.dataset.filled = "1"; inside(); }
      };
      const brief = value === undefined ? "left out" : Array.isArray(value) ? `${value.length}` : "";
      box.append(make("summary", {}, name, make("span", { className: "hint", textContent: brief })));
      const inside = () => {
        if (help) box.append(make("p", { className: "help hint", textContent: help }));
        if (value === undefined && kind === "object") {
          box.append(button(`Use ${name}`, `Add ${name} with the values that it needs`, () => edit(chosen(), [set(path, started(schema, path))])));
        } else box.append(...compoundParts(kind, schema, path, value, depth));
        if (clear) box.append(clear);
      };
      if (opened.has(id)) { box.dataset.filled = "1"; inside(); }
      return box;
    }
    const row = make("div", { className: "field", title: help });
    row.dataset.field = written(path);
    const own = control(kind, schema, path, value, name);
    row.append(make("span", { className: "name", textContent: name + unitOf(name) }), make("div", { className: "value" }, ...own, clear));
    if (help && depth < 2) row.append(make("p", { className: "help hint", textContent: help }));
    return row;
  }

  const unitOf = (name) => (name.endsWith("_deg") ? " (°)" : "");

  function variants(schema) { return (schema.oneOf || schema.anyOf || []).map(resolved); }

  function kindOf(schema, value) {
    if (schema.enum || schema.const !== undefined) return "choice";
    if (schema.properties) return "object";
    const all = variants(schema);
    if (all.length) {
      if (all.every((one) => one.const !== undefined || one.enum)) return "choice";
      if (isColor(all) && typeof value !== "string") return "color";
      return "variant";
    }
    if (schema.type === "array") {
      const items = resolved(schema.items || schema.prefixItems?.[0]);
      if (["number", "integer"].includes(items.type) && schema.maxItems <= 4 && schema.minItems === schema.maxItems) return "numbers";
      return "list";
    }
    if (schema.type === "object" || schema.properties) return schema.properties ? "object" : "map";
    if (schema.type === "number" || schema.type === "integer") return "number";
    if (schema.type === "boolean") return "boolean";
    if (schema.type === "string") return "string";
    return value !== null && typeof value === "object" ? "json" : "json";
  }

  /** Returns the variant of a schema that a value has. */
  function variantOf(all, value) {
    const fits = (one) => {
      if (value === undefined) return false;
      if (one.const !== undefined) return one.const === value;
      if (one.enum) return one.enum.includes(value);
      if (Array.isArray(value)) return one.type === "array";
      if (typeof value === "object") return one.type === "object" && Object.keys(value).every((key) => !one.properties || key in one.properties || one.additionalProperties);
      return one.type === (Number.isInteger(value) && one.type === "integer" ? "integer" : typeof value);
    };
    return all.findIndex(fits);
  }

  function compoundParts(kind, schema, path, value, depth) {
    if (kind === "object") return object(schema, path, value, depth + 1);
    if (kind === "variant") {
      const all = variants(schema), at = variantOf(all, value);
      const choose = make("select", { onchange: () => {
        const plain = starting(all[choose.value]), better = suggested(chosen(), path);
        edit(chosen(), [set(path, typeof better === typeof plain ? better : plain)]);
      } });
      choose.setAttribute("aria-label", `Form of ${written(path)}`);
      choose.append(make("option", { value: -1, textContent: "left out", disabled: true, selected: at < 0 }));
      all.forEach((one, k) => choose.append(make("option", { value: k, selected: k === at, textContent: nameOf(one) })));
      const rest = at < 0 ? [] : inner(all[at], path, value, depth);
      return [make("div", { className: "field" }, make("span", { className: "name", textContent: "form" }), make("div", { className: "value" }, choose)), ...rest];
    }
    if (kind === "map") {
      const items = resolved(schema.additionalProperties || {});
      const rows = Object.entries(value || {}).map(([key, one]) => field(key, items, [...path, key], one, depth + 1, true));
      const name = make("input", { type: "text", placeholder: "new name" });
      name.setAttribute("aria-label", `Name of a new entry of ${written(path)}`);
      const add = button("Add", "Add an entry", () => name.value && edit(chosen(), [set([...path, name.value], started(items, [...path, name.value]))]));
      return [...rows, make("div", { className: "field" }, make("span", { className: "name" }), make("div", { className: "value" }, name, add))];
    }
    const items = resolved(schema.items);
    const list = value || [];
    if (list.length > 60) return [...control("json", schema, path, value, "list")];
    const rows = list.map((one, k) => field(`${k + 1}`, items, [...path, k], one, depth + 1, true));
    const add = button("Add", "Add an element at the end", () => edit(chosen(), [list.length ? insert([...path, list.length], structuredClone(list[list.length - 1])) : set(path, [started(items, [...path, 0])])]));
    return [...rows, add];
  }

  function inner(schema, path, value, depth) {
    const kind = kindOf(schema, value);
    if (["object", "list", "map", "variant"].includes(kind)) return compoundParts(kind, schema, path, value, depth);
    return [make("div", { className: "field" }, make("span", { className: "name", textContent: "value" }), make("div", { className: "value" }, ...control(kind, schema, path, value, "value")))];
  }

  const nameOf = (schema) => {
    const keys = Object.keys(schema.properties || {});
    if (keys.length === 1) return keys[0];
    return schema.const ?? schema.title ?? (schema.required?.length ? schema.required.join(", ") : schema.type || "object");
  };

  /** Returns a value with which an entry starts. */
  function starting(node, depth = 0) {
    const schema = resolved(node);
    if (schema.default !== undefined && schema.default !== null) return schema.default;
    if (schema.const !== undefined) return schema.const;
    if (schema.enum) return schema.enum[0];
    const all = schema.properties ? [] : variants(schema);
    if (all.length && depth < 6) return starting(all[0], depth + 1);
    if (schema.type === "array") return Array.from({ length: Math.min(4, schema.minItems || 0) }, (_, k) => starting(schema.prefixItems?.[k] || schema.items, depth + 1));
    if (schema.type === "object") {
      const others = formsOf(schema);
      const more = schema.anyOf?.[0]?.required || [];
      const keys = depth < 6 ? [...(schema.required || []), ...others.slice(0, 1), ...more] : [];
      return Object.fromEntries(keys.map((key) => [key, starting(schema.properties[key], depth + 1)]));
    }
    if (schema.type === "boolean") return true;
    if (schema.type === "string") return "";
    const [low, high] = [schema.minimum ?? schema.exclusiveMinimum ?? -Infinity, schema.maximum ?? schema.exclusiveMaximum ?? Infinity];
    return low < 1 && high > 1 ? 1 : low < 0.5 && high > 0.5 ? 0.5 : Math.max(low, 0);
  }

  /** Returns the value with which the setting at a path starts. */
  const started = (schema, path) => suggested(chosen(), path) ?? starting(schema);

  function control(kind, schema, path, value, name) {
    const send = (next) => edit(chosen(), [next === undefined ? remove(path) : set(path, next)]);
    const label = (own, word) => { own.dataset.path = JSON.stringify(path); own.setAttribute("aria-label", word); return own; };
    if (kind === "choice") {
      const values = schema.enum || (schema.const !== undefined ? [schema.const] : variants(schema).flatMap((one) => one.enum || [one.const]));
      const own = make("select", { onchange: () => send(own.value === "" ? undefined : values.find((one) => String(one) === own.value)) });
      own.append(make("option", { value: "", textContent: "left out" }), ...values.map((one) => make("option", { value: String(one), textContent: String(one) })));
      own.value = value === undefined ? "" : String(value);
      return [label(own, name)];
    }
    if (kind === "boolean") return [label(make("input", { type: "checkbox", checked: !!value, onchange: (event) => send(event.target.checked) }), name)];
    if (kind === "number") {
      const own = number(schema, value, (next) => send(next));
      return [label(own, name), range(schema)];
    }
    if (kind === "numbers") {
      const count = schema.minItems;
      return Array.from({ length: count }, (_, k) => {
        const item = resolved(schema.prefixItems?.[k] || schema.items);
        const own = number(item, value?.[k], (next) => {
          const all = Array.from({ length: count }, (_, i) => (i === k ? next : valueAt(valueOf(chosen()), [...path, i]) ?? 0));
          send(all);
        });
        own.dataset.path = JSON.stringify([...path, k]);
        own.setAttribute("aria-label", `${name} ${k + 1} of ${count}`);
        return own;
      });
    }
    if (kind === "color") return colorControls(name, path, value, send);
    if (kind === "string") return [label(make("input", { type: "text", value: value ?? "", onchange: (event) => send(event.target.value || undefined) }), name), picker(path, send)];
    const own = make("input", { type: "text", value: value === undefined ? "" : JSON.stringify(value) });
    own.setAttribute("aria-label", `${name} as JSON`);
    own.addEventListener("change", () => {
      try { send(own.value ? JSON.parse(own.value) : undefined); own.setCustomValidity(""); } catch { own.setCustomValidity("expected JSON"); own.reportValidity(); }
    });
    return [own];
  }

  /** Returns a button that gives a picture to a setting that names one. */
  function picker(path, send) {
    const last = path[path.length - 1], above = path[path.length - 2];
    if (last !== "image" && last !== "picture" && !(last === "file" && above !== "mesh")) return null;
    return button("Choose…", "Take a picture of this computer, which is written beside the file", () =>
      choosePicture(async (file) => { const name = await upload(chosen(), file); if (name) send(name); }));
  }

  function number(schema, value, send) {
    const own = make("input", { type: "number", step: schema.type === "integer" ? 1 : "any", value: value ?? "", placeholder: schema.default ?? "" });
    if (Math.abs(schema.minimum ?? 1e30) < 1e20) own.min = schema.minimum;
    if (Math.abs(schema.maximum ?? 1e30) < 1e20) own.max = schema.maximum;
    own.addEventListener("change", () => send(own.value === "" ? undefined : Number(own.value)));
    return own;
  }

  function range(schema) {
    const near = (x) => x !== undefined && Math.abs(x) < 1e20;
    const low = near(schema.minimum) ? `from ${schema.minimum}` : near(schema.exclusiveMinimum) ? `above ${schema.exclusiveMinimum}` : "";
    const high = near(schema.maximum) ? `to ${schema.maximum}` : near(schema.exclusiveMaximum) ? `below ${schema.exclusiveMaximum}` : "";
    return make("span", { className: "hint", textContent: [low, high].filter(Boolean).join(" ") });
  }

  for (const name of ["state", "spec-check", "scene-check", "fault"]) on(name, () => show());
  return {
    show,
    /** Opens and focuses the control of a path. */
    go(path) {
      const parts = path.match(/[^.[\]]+|\[\d+\]/g) || [];
      let own = "";
      for (const part of parts) { own += part[0] === "[" ? part : own ? `.${part}` : part; opened.add(own); }
      show(true);
      const field = nearest(path);
      field?.scrollIntoView({ block: "center" });
      field?.querySelector("input, select, summary")?.focus({ preventScroll: true });
    },
  };
}
