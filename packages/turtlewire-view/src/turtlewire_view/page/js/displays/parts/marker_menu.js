// The menu of an interactive marker, at the pointer.

import { make } from "../../../kit/dom.js";

const STYLE = new URL("../../../marker_menu.css", import.meta.url).href;
let open = null;

/**
 * Show a menu at [x, y] of the viewport. `entries`: { id, parent, title, runs }; a parent of 0 is
 * the first level. `choose(id)` is called with the entry that the user selects.
 */
export function openMenu(entries, [x, y], choose) {
  closeMenu();
  const around = document.getElementById("viewport");
  const menu = make("div", { className: "marker-menu" });
  menu.setAttribute("role", "menu");
  menu.append(...level(entries, 0, new Set(), (id) => {
    closeMenu();
    choose(id);
  }));
  around.append(menu);
  const { clientWidth, clientHeight } = around;
  menu.style.left = `${Math.max(0, Math.min(x, clientWidth - menu.offsetWidth))}px`;
  menu.style.top = `${Math.max(0, Math.min(y, clientHeight - menu.offsetHeight))}px`;
  const leave = (event) => {
    if (event.type === "keydown" ? event.key === "Escape" : !menu.contains(event.target)) {
      event.stopPropagation();
      closeMenu();
    }
  };
  addEventListener("pointerdown", leave, true);
  addEventListener("keydown", leave, true);
  open = { menu, leave };
  menu.querySelector("button:not(:disabled), summary")?.focus();
}

export function closeMenu() {
  if (!open) return;
  removeEventListener("pointerdown", open.leave, true);
  removeEventListener("keydown", open.leave, true);
  open.menu.remove();
  open = null;
}

/** The entries below a parent; `above` are the parents of these, for a menu may be a circle. */
function level(entries, parent, above, choose) {
  return entries.filter((entry) => entry.parent === parent && !above.has(entry.id)).map((entry) => {
    const inner = level(entries, entry.id, new Set([...above, entry.id]), choose);
    if (inner.length) {
      return make("details", {}, make("summary", { textContent: entry.title }), ...inner);
    }
    const button = make("button", { type: "button", textContent: entry.title });
    button.setAttribute("role", "menuitem");
    button.onclick = () => choose(entry.id);
    if (entry.runs) {
      button.disabled = true;
      button.title = `This page starts no programs: ${entry.runs}`;
    }
    return button;
  });
}

/** Load the style of menus; before the first one opens. */
export function prepareMenus() {
  if (document.querySelector(`link[href="${STYLE}"]`)) return;
  document.head.append(make("link", { rel: "stylesheet", href: STYLE }));
}
