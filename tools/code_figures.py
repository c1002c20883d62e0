"""Figures of the code: import cycles, packages, lengths, comments, tests, uses of private names."""

from __future__ import annotations

import ast
import io
import statistics
import tokenize
from collections import Counter
from typing import TYPE_CHECKING

from architecture import room

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator
    from pathlib import Path

    from architecture import House

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
