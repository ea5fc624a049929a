// Lists of tabs, by pointer and by arrow keys.

/** Starts the tabs of a pane. `shown` has functions that are called when a panel appears. Returns the choice of a panel. */
export function tabs(pane, shown) {
  const all = [...pane.querySelectorAll('[role="tab"]')];
  const panel = (tab) => document.getElementById(tab.getAttribute("aria-controls"));

  function choose(tab, focus = false) {
    for (const other of all) {
      const is = other === tab;
      other.setAttribute("aria-selected", is);
      other.tabIndex = is ? 0 : -1;
      panel(other).hidden = !is;
    }
    if (focus) tab.focus();
    shown[tab.getAttribute("aria-controls")]?.();
  }

  all.forEach((tab, k) => {
    tab.tabIndex = tab.getAttribute("aria-selected") === "true" ? 0 : -1;
    tab.addEventListener("click", () => choose(tab));
    tab.addEventListener("keydown", (event) => {
      const by = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
      if (by) { event.preventDefault(); choose(all[(k + by + all.length) % all.length], true); }
    });
  });
  return (id) => choose(all.find((tab) => tab.getAttribute("aria-controls") === id));
}
