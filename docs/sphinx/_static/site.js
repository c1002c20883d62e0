// Makes elements that scroll sideways reachable by keyboard, names the columns next to the text,
// and adds a menu of the versions, if the site has several.

const watch = new ResizeObserver((entries) => {
  for (const { target } of entries) {
    if (target.scrollWidth > target.clientWidth) target.tabIndex = 0;
    else target.removeAttribute("tabindex");
  }
});
for (const box of document.querySelectorAll("pre, .table-wrapper")) watch.observe(box);

document.querySelector(".sidebar-drawer")?.setAttribute("aria-label", "Pages");
document.querySelector(".toc-drawer")?.setAttribute("aria-label", "This page");

const version = document.querySelector(".version");

function addVersionMenu(releases) {
  const root = new URL(version.dataset.root, location.href);
  const menu = document.createElement("select");
  menu.setAttribute("aria-label", "Version of these pages");
  for (const name of ["", ...releases]) {
    menu.append(new Option(name || "newest state", name, false, name === version.dataset.release));
  }
  menu.addEventListener("change", () => {
    location.href = new URL(menu.value ? `${menu.value}/index.html` : "index.html", root).href;
  });
  version.append(" ", menu);
}

// Files opened without a server may not fetch others.
if (version && location.protocol.startsWith("http")) {
  fetch(new URL("versions.json", new URL(version.dataset.root, location.href)))
    .then((answer) => (answer.ok ? answer.json() : []))
    .then((releases) => releases.length && addVersionMenu(releases));
}
