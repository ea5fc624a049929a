// The state that the program announced, and the changes that this window asks for.

import { post } from "./api.js";

const listeners = new Map();
const parsed = new Map();

/** What the program announced last, by the name of its event. */
export const known = { state: { files: [] }, curves: { specs: {} } };

/** Calls a function after each event of a name. */
export function on(name, call) {
  if (!listeners.has(name)) listeners.set(name, []);
  listeners.get(name).push(call);
}

/** Keeps an event and calls those who wait for it. */
export function announce(name, value) {
  known[name] = value;
  for (const call of listeners.get(name) || []) call(value);
}

/** Returns the opened file of a path. */
export const fileOf = (path) => known.state.files.find((file) => file.path === path);

/** Returns the value of an opened JSON file; undefined while its text has a fault. */
export function valueOf(path) {
  const file = fileOf(path);
  if (!file) return undefined;
  const old = parsed.get(path);
  if (old && old.text === file.text) return old.value;
  let value;
  try { value = JSON.parse(file.text); } catch { value = undefined; }
  parsed.set(path, { text: file.text, value });
  return value;
}

/** Returns the value at a path of keys and indices, or undefined. */
export const at = (value, path) => path.reduce((inner, step) => inner?.[step], value);

/** Returns a path as messages write it, such as `contour.bezier.segments[0][1]`. */
export const written = (path) =>
  path.reduce((text, step) => (typeof step === "number" ? `${text}[${step}]` : text ? `${text}.${step}` : step), "");

export const set = (path, value) => ({ do: "set", path, value });
export const insert = (path, value) => ({ do: "insert", path, value });
export const remove = (path) => ({ do: "remove", path });

let sending = null;
let waiting = [];
let gestures = 0;

/** Returns a new word for a gesture, whose edits are one step of the history. */
export const newGesture = () => `${Date.now().toString(36)}-${++gestures}`;

/**
 * Asks for edits of a file. Edits of one gesture that come while an earlier request runs are merged, so that a fast
 * pointer does not fill a queue.
 */
export function edit(file, edits, gesture = "", ends = true) {
  const last = waiting[waiting.length - 1];
  const paths = new Set(edits.map((one) => JSON.stringify(one.path)));
  const only = (list) => list.every((one) => one.do === "set");
  if (last && gesture && last.gesture === gesture && last.file === file && only(last.edits) && only(edits)) {
    last.edits = last.edits.filter((one) => !paths.has(JSON.stringify(one.path))).concat(edits);
    last.ends = ends;
  } else {
    waiting.push({ file, edits, gesture, ends, asked: performance.now() });
  }
  sending ??= send();
  return sending;
}

async function send() {
  try {
    while (waiting.length) {
      const { asked, ...next } = waiting.shift();
      try {
        const { revision } = await post("edit", next);
        // Tests measure the time from a movement to its picture.
        document.dispatchEvent(new CustomEvent("edit-answered", { detail: { asked, revision } }));
      } catch (error) { announce("refused", error.message); }
    }
  } finally {
    sending = null;
  }
}

/** Returns whether edits are on their way. */
export const isSending = () => sending !== null;

/** Sends a request and shows its refusal. Returns the answer, or null. */
export async function ask(path, value) {
  try { return await post(path, value); } catch (error) { announce("refused", error.message); return null; }
}
