// Positions of values in a JSON text.

/** Returns the steps of a path such as `contour.bezier.segments[0][1]`. */
export function stepsOf(path) {
  return (path.match(/[^.[\]]+|\[\d+\]/g) || []).map((part) => (part[0] === "[" ? Number(part.slice(1, -1)) : part));
}

/** Returns the line, from 1, of the value at a path, or of the deepest value on the path that exists. */
export function lineOf(text, path) {
  const wanted = stepsOf(path);
  let at = 0, best = 0, deepest = -1;
  const space = () => { while (/\s/.test(text[at])) at++; };
  const string = () => {
    const start = at++;
    while (at < text.length && text[at] !== '"') at += text[at] === "\\" ? 2 : 1;
    at++;
    try { return JSON.parse(text.slice(start, at)); } catch { return ""; }
  };
  function value(depth, matches) {
    space();
    if (matches && depth > deepest) { deepest = depth; best = at; }
    if (text[at] === "{" || text[at] === "[") {
      const isList = text[at] === "[";
      at++;
      for (let k = 0; at < text.length; k++) {
        space();
        if (text[at] === "}" || text[at] === "]") { at++; return; }
        if (text[at] === ",") { at++; space(); }
        let key = k;
        if (!isList) { if (text[at] !== '"') return; key = string(); space(); at++; }
        value(depth + 1, matches && wanted[depth] === key);
      }
    } else if (text[at] === '"') string();
    else while (at < text.length && !/[\s,\]}]/.test(text[at])) at++;
  }
  value(0, true);
  return text.slice(0, best).split("\n").length;
}
