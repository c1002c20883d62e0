"""Sphinx's configuration of the site of ``docs/``; `scripts/docs` runs Sphinx."""

from __future__ import annotations

import builtins
import os
import re
import sys
from importlib.metadata import version as installed_version
from pathlib import Path
from typing import TYPE_CHECKING, Any

from sphinx.addnodes import pending_xref, pending_xref_condition
from sphinx.transforms import SphinxTransform

if TYPE_CHECKING:
    from sphinx.application import Sphinx

ROOT = Path(__file__).resolve().parents[2]
DOCS = ROOT / "docs"
#: The plain-Python twin of the compiled core has its docstrings in Python, with types.
os.environ["TURTLEWIRE_CORE"] = "python"
sys.path[:0] = [str(ROOT / "tools"), str(DOCS / "sphinx")]

from distributions import import_path  # noqa: E402 -- its folder was unknown before
from docs_releases import is_of_release  # noqa: E402

sys.path[:0] = map(str, import_path())

project = "turtlewire"
author = "The turtlewire authors"
project_copyright = "The turtlewire authors, Apache-2.0"
release = installed_version("turtlewire")
extensions = [
    "myst_parser",
    "sphinx.ext.autodoc",
    "sphinx.ext.napoleon",
    "sphinx_copybutton",
    "sphinx_design",
    "accessible_pages",
]
exclude_patterns = ["style.md", "sphinx"]
default_role = "py:obj"  # `name` in a docstring is code, and a link where the site has that name

myst_enable_extensions = ["colon_fence", "attrs_inline", "deflist"]
myst_heading_anchors = 3
# A type is named as the source names it, for example `Buffer`; there are several.
suppress_warnings = ["ref.python"]

napoleon_use_ivar = True

autodoc_typehints = "signature"
autodoc_typehints_format = "short"
autodoc_member_order = "groupwise"
autodoc_default_options = {"members": True}
python_maximum_signature_line_length = 88
python_use_unqualified_type_names = True
toc_object_entries_show_parents = "hide"

templates_path = ["_templates"]
html_theme = "furo"
html_title = "turtlewire"
html_favicon = "../../packages/turtlewire/src/turtlewire/web/kit/turtle.svg"
html_static_path = ["_static"]
html_css_files = ["site.css"]
html_js_files = [("site.js", {"defer": "defer"})]
html_copy_source = False
html_show_sphinx = False
html_sidebars = {
    "**": [
        "sidebar/brand.html",
        "sidebar/search.html",
        "sidebar/version.html",
        "sidebar/run.html",
        "sidebar/scroll-start.html",
        "sidebar/navigation.html",
        "sidebar/scroll-end.html",
    ]
}
pygments_style = "a11y-high-contrast-light"
pygments_dark_style = "a11y-high-contrast-dark"
copybutton_prompt_text = r">>> |\.\.\. |\$ "
copybutton_prompt_is_regexp = True

locale_dirs = [str(DOCS / "sphinx" / "locale")]
gettext_compact = False
gettext_uuid = False
gettext_location = False


def setup(app: Sphinx) -> None:
    """Register what this site adds to Sphinx."""
    app.add_transform(LeaveBuiltinsAlone)
    app.connect("html-page-context", name_version)
    app.connect("source-read", name_files_outside)
    app.connect("source-read", add_unsorted_pages)
    app.connect("source-read", add_run_button)
    app.connect("autodoc-process-docstring", leave_out_module_tables)


def name_version(
    app: Sphinx, _pagename: str, _template: str, context: dict[str, Any], _doctree: object
) -> None:
    """Give the template the release whose folder this is, and where the root of the site is."""
    base = str(app.config.html_context.get("base", "/"))  # what `-A` sets is in the context
    context["release_shown"] = release if is_of_release(base, release) else ""
    context["site_root"] = "../" if context["release_shown"] else ""


def name_files_outside(_app: Sphinx, docname: str, source: list[str]) -> None:
    """Show links to files of the repository outside ``docs/`` as their paths."""
    folder = (DOCS / docname).parent

    def shown(link: re.Match[str]) -> str:
        target = (folder / link[2]).resolve()
        if target.is_relative_to(DOCS) or not target.exists():
            return link[0]
        return f"{link[1]} (`{target.relative_to(ROOT).as_posix()}`)"

    source[0] = re.sub(r"\[([^\]]+)\]\(((?:\.\./)+[^)#]*)\)", shown, source[0])


def add_unsorted_pages(_app: Sphinx, docname: str, source: list[str]) -> None:
    """List the pages that the front page's contents do not name, under a heading of their own."""
    if docname != "index":
        return
    pages = {path.relative_to(DOCS).with_suffix("").as_posix() for path in DOCS.rglob("*.md")}
    unsorted = sorted(pages - {*source[0].splitlines(), "index", "404", "style"})
    if unsorted:
        names = "\n".join(unsorted)
        source[0] += f"\n```{{toctree}}\n:caption: More\n:hidden:\n\n{names}\n```\n"


def add_run_button(_app: Sphinx, docname: str, source: list[str]) -> None:
    """Let the how-to page about the lesson open the one of this site."""
    if docname != "how-to/lesson":
        return
    title, rest = source[0].split("\n\n", 1)
    button = "```{button-link} ../lesson/index.html\n:color: primary\n\n▶ Run\n```"
    own = "**Run** opens it here. To build a page of your own,"
    source[0] = f"{title}\n\n{button}\n\n{own}\n\n{rest}"


def leave_out_module_tables(
    _app: Sphinx, what: str, _name: str, _obj: object, _options: object, lines: list[str]
) -> None:
    """Drop the map of a package's modules, which is for contributors."""
    if what != "module":
        return
    borders = [index for index, line in enumerate(lines) if re.fullmatch(r"=+( +=+)+", line)]
    if len(borders) >= 3 and lines[borders[0] + 1].startswith("module"):
        del lines[borders[0] : borders[2] + 1]


class LeaveBuiltinsAlone(SphinxTransform):
    """Keep the annotation ``type`` from becoming a link to some attribute of that name."""

    default_priority = 400

    def apply(self, **_kwargs: Any) -> None:
        """Replace references to built-in names by their text."""
        for node in list(self.document.findall(pending_xref)):
            if node["refdomain"] == "py" and hasattr(builtins, node["reftarget"]):
                shown = list(node.findall(pending_xref_condition))
                node.replace_self(shown[0].children if shown else node.children)
