"""The import graph: modules, import cycles and packages, read from the sources.

`scripts/architecture` draws docs/images/architecture.svg; `--check` fails if it is stale;
`--figures` prints figures of the code, with `--root` of another checkout.
"""

from __future__ import annotations

import ast
import configparser
import io
import statistics
import sys
import tokenize
from collections import Counter, defaultdict
from collections.abc import Iterable, Iterator
from html import escape
from pathlib import Path
from typing import NamedTuple

from script_options import ScriptParser

WIDTH, BOX, ROW, TOP = 1180, 30, 82, 12
STYLE = """
  text { font: 13px system-ui, sans-serif; fill: #1b2a35 }
  rect { stroke: #7d8f9b; rx: 6 } .engine { fill: #dcefe6 } .ros { fill: #e3ebf7 }
  .shells { fill: #f6eeda } path { fill: none; stroke: #8fa1ad } .up { stroke: #c0392b }
  @media (prefers-color-scheme: dark) {
    text { fill: #e4ebf0 } path { stroke: #6b7f8c }
    .engine { fill: #1f4a3a } .ros { fill: #243b5c } .shells { fill: #54471f }
  }
"""


def draw(house: House) -> str:
    """Return the picture; the same for the same imports."""
    arrows = house.rooms()
    rows = _rows(arrows)
    places = {
        name: ((index + 0.5) * WIDTH / len(row), TOP + number * ROW)
        for number, row in enumerate(reversed(rows))
        for index, name in enumerate(row)
    }
    lines = [
        _arrow(places[source], places[target], "")
        for source, targets in _essential(arrows).items()
        for target in sorted(targets)
    ]
    upward = sorted({(room(source), room(target)) for source, target in house.excused})
    lines += [_arrow(places[source], places[target], ' class="up"') for source, target in upward]
    boxes = [_box(name, place) for name, place in sorted(places.items())]
    height = TOP + len(rows) * ROW
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {height}" role="img" '
        f'aria-label="Rooms of turtlewire and who imports whom">\n<style>{STYLE}</style>\n'
        + "\n".join([*lines, *boxes])
        + "\n</svg>\n"
    )


def _rows(arrows: dict[str, set[str]]) -> list[list[str]]:
    """Return the rooms by height, the lowest first; a room stands above all that it imports."""
    height: dict[str, int] = {}
    for group in strong_components(arrows, arrows):
        below = {target for name in group for target in arrows[name]} - {*group}
        for name in group:
            height[name] = 1 + max((height[target] for target in below), default=-1)
    rows: list[list[str]] = []
    for level in range(max(height.values()) + 1):
        row = [name for name in arrows if height[name] == level]
        rows.append(sorted(row, key=lambda name: (_middle(name, arrows, rows), name)))
    return rows


def _middle(name: str, arrows: dict[str, set[str]], rows: list[list[str]]) -> float:
    """Return the mean position of a room's imports, from 0 to 1, so that few arrows cross."""
    spots = [
        (index + 0.5) / len(row)
        for row in rows
        for index, other in enumerate(row)
        if other in arrows[name]
    ]
    return round(sum(spots) / len(spots), 6) if spots else 0.5


def _essential(arrows: dict[str, set[str]]) -> dict[str, set[str]]:
    """Return the arrows without those that a longer way says too."""
    reach: dict[str, set[str]] = {}
    for name, *_ in strong_components(arrows, arrows):
        reach[name] = set().union(*({t} | reach.get(t, set()) for t in arrows[name]), set())
    return {
        name: {
            target
            for target in targets
            if not any(target in reach.get(other, set()) for other in targets - {target})
        }
        for name, targets in arrows.items()
    }


def _arrow(start: tuple[float, float], end: tuple[float, float], style: str) -> str:
    x, y, to_x, to_y = start[0], start[1] + BOX, end[0], end[1]
    if to_y < y:  # upwards: along the sides of the boxes
        y, to_y = start[1], end[1] + BOX
    bend = (y + to_y) / 2
    way = f"M{x:.0f} {y:.0f}C{x:.0f} {bend:.0f} {to_x:.0f} {bend:.0f} {to_x:.0f} {to_y:.0f}"
    return f'<path{style} d="{way}"/>'


def _box(name: str, place: tuple[float, float]) -> str:
    in_engine = name == ENGINE or name.startswith(f"{ENGINE}.")
    kind = "shells" if name == SHELLS else "engine" if in_engine else "ros"
    x, y = place
    width = 8 * len(name) + 16
    return (
        f'<rect class="{kind}" x="{x - width / 2:.0f}" y="{y}" width="{width}" height="{BOX}"/>'
        f'<text x="{x:.0f}" y="{y + 20}" text-anchor="middle">{escape(name)}</text>'
    )


#: Names with an underscore that are public: of named tuples, of messages in ROS 2, and of Jupyter.
PUBLIC = {
    *("_replace", "_asdict", "_fields", "_make"),
    *("_TYPE_SUPPORT", "_fields_and_field_types"),
    *("_repr_svg_", "_repr_html_"),
}


def figures(root: Path, house: House) -> str:
    """Return a table in Markdown."""
    arrows = house.rooms()
    lines = {name: path.read_text("utf-8").splitlines() for name, path in house.paths.items()}
    code = sum(map(len, lines.values()))
    comments = sum(map(_comments, house.paths.values()))
    privates = Counter(room(name) for name, tree in house.trees.items() for _ in _privates(tree))
    functions = [length for tree in house.trees.values() for length in _functions(tree)]
    rows = [
        ("modules, lines", f"{len(lines)}, {code}"),
        ("circles, imports for types included", _circles(house, "run", "late", "type")),
        ("circles, imports in functions included", _circles(house, "run", "late")),
        ("circles at import time", _circles(house, "run")),
        ("rooms, and generated packages", f"{len(arrows) - 1}, {len(house.shells)}"),
        ("arrows between rooms", f"{sum(map(len, arrows.values()))}"),
        ("arrows upward", f"{len(house.excused)}"),
        ("lines of a module, median and 95 %", _spread(map(len, lines.values()))),
        ("lines of a function, median and 95 %", _spread(functions)),
        (
            "characters of a line, median and 95 %",
            _spread(len(line) for text in lines.values() for line in text if line.strip()),
        ),
        ("comments per 100 lines", f"{100 * comments / code:.1f}"),
        ("privates read across objects", f"{privates.total()} ({_counts(privates)})"),
        ("lines of test per line of code", _tests(root, lines)),
    ]
    return "\n".join(
        ["| figure | |", "|---|---|", *(f"| {name} | {text} |" for name, text in rows)]
    )


def _circles(house: House, *kinds: str) -> str:
    circles = house.circles(*kinds)
    named = ", ".join(f"{len(circle)} {room(circle[0])}" for circle in circles)
    return f"{len(circles)} ({named})" if circles else "0"


def _spread(numbers: Iterable[int]) -> str:
    numbers = list(numbers)
    return f"{statistics.median(numbers):.0f}, {statistics.quantiles(numbers, n=20)[-1]:.0f}"


def _functions(tree: ast.AST) -> Iterator[int]:
    for node in ast.walk(tree):
        if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef)) and node.end_lineno:
            yield node.end_lineno - node.lineno + 1


def _comments(path: Path) -> int:
    with path.open("rb") as source:
        tokens = tokenize.tokenize(io.BytesIO(source.read()).readline)
        return sum(token.type == tokenize.COMMENT for token in tokens)


def _privates(tree: ast.AST) -> Iterator[str]:
    """Names with one underscore that are read from other objects."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Attribute) and node.attr.startswith("_"):
            own = ast.unparse(node.value) in {"self", "cls", "super()"}
            if not own and not node.attr.startswith("__") and node.attr not in PUBLIC:
                yield node.attr


def _counts(counter: Counter[str]) -> str:
    return ", ".join(f"{name} {count}" for name, count in counter.most_common() if count > 1)


def _tests(root: Path, lines: dict[str, list[str]]) -> str:
    code = Counter[str]()
    for name, text in lines.items():
        code[room(name).removeprefix("turtlewire.")] += len(text)
    shares = {}
    for name, count in code.items():
        paths = root.glob(f"packages/**/tests/{name}/**/*.py")
        tests = sum(len(path.read_text("utf-8").splitlines()) for path in paths)
        if tests:
            shares[name] = tests / count
    return ", ".join(f"{name} {share:.2f}" for name, share in sorted(shares.items()))


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
        print(figures(arguments.root, house))
        return 0
    path, drawn = arguments.root / "docs" / "images" / "architecture.svg", draw(house)
    if not arguments.check:
        path.write_text(drawn, encoding="utf-8")
    elif path.read_text(encoding="utf-8") != drawn:
        print(f"{path.name} is stale: run scripts/architecture")
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
