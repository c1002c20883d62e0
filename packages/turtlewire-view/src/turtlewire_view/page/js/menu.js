// While a menu is open over the page, a click or Escape only closes it.

/** Let Escape, and a press elsewhere, close an open `details`; the picture takes no such press. */
export function closeFirst(menu) {
  const first = { capture: true };
  addEventListener("keydown", (event) => {
    if (event.key !== "Escape" || !menu.open) return;
    event.stopPropagation();
    menu.open = false;
    menu.querySelector("summary").focus();
  }, first);
  addEventListener("pointerdown", (event) => {
    if (!menu.open || menu.contains(event.target)) return;
    menu.open = false;
    if (event.target.matches("canvas")) event.stopPropagation();
  }, first);
}
