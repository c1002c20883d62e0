"""The import graph: modules, import cycles and packages, read from the sources.

`scripts/architecture` draws docs/images/architecture.svg; `--check` fails if it is stale;
`--figures` prints figures of the code, with `--root` of another checkout.
"""

from __future__ import annotations

import ast
import configparser
import sys
from collections import defaultdict
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from script_options import ScriptParser

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

ROOT = Path(__file__).resolve().parent.parent
ENGINE = "turtlewire"
SHELLS = "interfaces"


class Import(NamedTuple):
    """One module imports another.

    Attributes:
        source: The importing module.
        target: The imported one.
        kind: ``run`` at import time, ``late`` inside a function, ``type`` for type checkers only.
    """

    source: str
    target: str
    kind: str


class House:
    """The modules of a checkout and their imports of each other.

    The generated interface packages count as one package and have no modules here.
    """

    def __init__(self, root: Path) -> None:
        interfaces = root / "packages/turtlewire/src/turtlewire/msg/interfaces"
        # turtlesim has code besides its interfaces.
        self.shells = {file.stem for file in interfaces.glob("*.txt")} - {"turtlesim"}
        self.paths = dict(_modules(root))
        self.trees = {name: ast.parse(path.read_bytes()) for name, path in self.paths.items()}
        self.imports = sorted({found for name in self.trees for found in self._imports(name)})
        self.excused = _excused(root)

    def _imports(self, name: str) -> Iterator[Import]:
        is_package = self.paths[name].name == "__init__.py"
        package = name if is_package else name.rpartition(".")[0]
        for node, kind in _import_nodes(self.trees[name], "run"):
            for target in self._targets(node, package):
                if target != name:
                    yield Import(name, target, kind)

    def _targets(self, node: ast.Import | ast.ImportFrom, package: str) -> Iterator[str]:
        if isinstance(node, ast.Import):
            yield from (found for alias in node.names if (found := self._known(alias.name)))
            return
        base = node.module or ""
        if node.level:
            above = package.split(".")[: package.count(".") + 2 - node.level]
            base = ".".join([*above, base] if base else above)
        for alias in node.names:
            if found := self._known(f"{base}.{alias.name}") or self._known(base):
                yield found

    def _known(self, name: str) -> str | None:
        if name.partition(".")[0] in self.shells:
            return SHELLS
        return name if name in self.paths else None

    def circles(self, *kinds: str) -> list[list[str]]:
        """Groups of modules that import each other by these kinds of imports, largest first."""
        arrows = defaultdict(set)
        for found in self.imports:
            if found.kind in kinds:
                arrows[found.source].add(found.target)
        groups = [sorted(group) for group in strong_components(sorted(self.paths), arrows)]
        return sorted((group for group in groups if len(group) > 1), key=lambda g: (-len(g), g))

    def rooms(self) -> dict[str, set[str]]:
        """Return each room with the rooms that its modules import."""
        arrows: dict[str, set[str]] = {room(name): set() for name in self.paths}
        arrows[SHELLS] = {"turtlewire.msg"}
        for found in self.imports:
            if (found.source, found.target) not in self.excused:
                arrows[room(found.source)].add(room(found.target))
        return {name: targets - {name} for name, targets in sorted(arrows.items())}


def room(module: str) -> str:
    """Return the room of a module: a package of ROS 2, or a package or module of the engine."""
    parts = module.split(".")
    return ".".join(parts[:2]) if parts[0] == ENGINE else parts[0]


def _modules(root: Path) -> Iterator[tuple[str, Path]]:
    for init in sorted(root.glob("packages/*/*/*/__init__.py")):
        for path in sorted(init.parent.rglob("*.py")):
            parts = path.relative_to(init.parents[1]).with_suffix("").parts
            yield ".".join(parts[:-1] if parts[-1] == "__init__" else parts), path


def _excused(root: Path) -> set[tuple[str, str]]:
    """Imports that .importlinter lets run upwards; wildcards there excuse circles only."""
    contracts = configparser.ConfigParser()
    contracts.read(root / ".importlinter", encoding="utf-8")
    return {
        (source.strip(), target.strip())
        for section in contracts.values()
        for line in section.get("ignore_imports", "").splitlines()
        for source, arrow, target in [line.partition("->")]
        if arrow and "*" not in line
    }


def _import_nodes(node: ast.AST, kind: str) -> Iterator[tuple[ast.Import | ast.ImportFrom, str]]:
    for child in _statements(node):
        if isinstance(child, (ast.Import, ast.ImportFrom)):
            yield child, kind
        elif isinstance(child, ast.If) and ast.unparse(child.test).endswith("TYPE_CHECKING"):
            yield from _import_nodes(ast.Module(child.body, []), "type")
            yield from _import_nodes(ast.Module(child.orelse, []), kind)
        elif isinstance(child, (ast.FunctionDef, ast.AsyncFunctionDef)):
            yield from _import_nodes(child, "late" if kind == "run" else kind)
        else:
            yield from _import_nodes(child, kind)


def _statements(node: ast.AST) -> Iterator[ast.AST]:
    """Yield the statements right below a node, and what else holds statements; no expressions."""
    for name in ("body", "handlers", "orelse", "finalbody", "cases"):
        found = getattr(node, name, ())
        if isinstance(found, list):  # of a lambda and of `a if b else c` they are expressions
            yield from found


def strong_components(nodes: Iterable[str], arrows: dict[str, set[str]]) -> list[list[str]]:
    """Tarjan's strongly connected components; each comes after those that it points to."""
    index: dict[str, int] = {}
    low: dict[str, int] = {}
    stack: list[str] = []
    found: list[list[str]] = []

    def visit(node: str) -> None:
        index[node] = low[node] = len(index)
        stack.append(node)
        for target in sorted(arrows.get(node, ())):
            if target not in index:
                visit(target)
                low[node] = min(low[node], low[target])
            elif target in stack:
                low[node] = min(low[node], index[target])
        if low[node] == index[node]:
            at = stack.index(node)
            found.append(stack[at:])
            del stack[at:]

    for node in nodes:
        if node not in index:
            visit(node)
    return found


def main() -> int:
    """Draw the map, check it or print figures; the exit status."""
    parser = ScriptParser(prog="scripts/architecture", description=__doc__)
    mode = parser.add_mutually_exclusive_group()
    mode.add_argument("--check", action="store_true", help="fail if the map is stale")
    mode.add_argument("--figures", action="store_true", help="print figures of the code")
    parser.add_argument("--root", type=Path, default=ROOT, help="another checkout")
    arguments = parser.parse_args()
    house = House(arguments.root)
    if arguments.figures:
        from code_figures import figures

        print(figures(arguments.root, house))
        return 0
    from architecture_map import draw

    path, drawn = arguments.root / "docs" / "images" / "architecture.svg", draw(house)
    if not arguments.check:
        path.write_text(drawn, encoding="utf-8")
    elif path.read_text(encoding="utf-8") != drawn:
        print(f"{path.name} is stale: run scripts/architecture")
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
