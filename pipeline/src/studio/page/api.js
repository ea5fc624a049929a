// Requests to the program, and its events.

const at = (path) => new URL("api/" + path, document.baseURI);

/** Sends a value and returns the answer. Throws an Error with a sentence if the program refuses. */
export async function post(path, value = {}) {
  let response;
  try {
    response = await fetch(at(path), {
      method: "POST", headers: { "content-type": "application/json" }, body: JSON.stringify(value),
    });
  } catch {
    throw new Error("The program does not answer. Is it still running?");
  }
  return answer(response);
}

/** Sends the bytes of a file and returns the answer. */
export async function sendFile(path, file) {
  let response;
  try {
    response = await fetch(at(path), { method: "POST", headers: { "content-type": "application/octet-stream" }, body: file });
  } catch {
    throw new Error("The program does not answer. Is it still running?");
  }
  return answer(response);
}

/** Returns the answer to a question without a value. */
export async function get(path) {
  return answer(await fetch(at(path)));
}

async function answer(response) {
  const text = await response.text();
  let value = {};
  try { value = JSON.parse(text); } catch { value = { message: text }; }
  if (!response.ok) throw new Error(value.message || `The program refused with code ${response.status}.`);
  return value;
}

/** The address of a picture. */
export const pictureAddress = (id) => at(`picture/${id}`).href;

/**
 * Listens to events until the page closes. `heard` gets the name and the value of each event, and `connected` is told
 * whether the program answers. A lost connection is tried again.
 */
export function listen(names, heard, connected) {
  let source = null;
  const start = () => {
    source = new EventSource(at("events"));
    source.onopen = () => connected(true);
    source.onerror = () => {
      connected(false);
      if (source.readyState === EventSource.CLOSED) setTimeout(start, 1000);
    };
    for (const name of names) source.addEventListener(name, (event) => heard(name, JSON.parse(event.data)));
    source.addEventListener("lagged", () => { source.close(); start(); });
  };
  start();
}
