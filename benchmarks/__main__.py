"""Run the benchmarks named on the command line, or all, and print one table for each.

A benchmark is a module of this package with ``TITLE`` and ``rows()``, which yields
:class:`benchmarks.figures.Row`.
"""

from __future__ import annotations

import importlib
import os
import pkgutil
import platform
import sys
from types import ModuleType
from typing import TYPE_CHECKING

import benchmarks
from turtlewire.program import program

if TYPE_CHECKING:
    from benchmarks.figures import Row


def name_of(module: ModuleType) -> str:
    return module.__name__.removeprefix("benchmarks.")


def modules() -> list[ModuleType]:
    found = []
    for info in pkgutil.iter_modules(benchmarks.__path__, "benchmarks."):
        if info.ispkg or info.name.endswith("__main__"):
            continue
        module = importlib.import_module(info.name)
        if hasattr(module, "rows"):
            found.append(module)
    return found


def table(rows: list[Row]) -> str:
    lines = [
        (
            "what",
            "ours (min / median)",
            "rival",
            "rival (min / median)",
            "ratio (min / median)",
            "budget",
        )
    ]
    for row in rows:
        first = (row.what, row.ours.text() + _above_floor(row))
        if not row.rivals:
            lines.append((*first, "", "", "", row.budget))
        for name, rival in row.rivals.items():
            ratio = (
                f"{rival.minimum / row.ours.minimum:.3g}x / {rival.median / row.ours.median:.3g}x"
            )
            lines.append((*first, name, rival.text(), ratio, row.budget))
    widths = [max(map(len, column)) for column in zip(*lines, strict=True)]
    cells = [
        "| "
        + " | ".join(cell.ljust(width) for cell, width in zip(line, widths, strict=True))
        + " |"
        for line in lines
    ]
    cells.insert(1, "|" + "|".join("-" * (width + 2) for width in widths) + "|")
    return "\n".join(cells)


def _above_floor(row: Row) -> str:
    if row.floor is None:
        return ""
    least, typical = row.ours.minimum / row.floor.minimum, row.ours.median / row.floor.median
    return f"; floor {row.floor.text()}: {least:.3g}x / {typical:.3g}x of it"


def main() -> int:
    wanted = sys.argv[1:]
    found = modules()
    names = [name_of(module) for module in found]
    if missing := set(wanted) - set(names):
        print(f"no such benchmark: {', '.join(sorted(missing))}", file=sys.stderr)
        print(f"there are: {', '.join(names)}", file=sys.stderr)
        return 2
    print(f"Python {platform.python_version()}, {platform.machine()}, {platform.system()}")
    for module in found:
        if wanted and name_of(module) not in wanted:
            continue
        print(f"\n{module.TITLE}\n", flush=True)
        print(table(list(module.rows())), flush=True)
        print("load average: {:.1f} (1 min), {:.1f} (5 min)".format(*os.getloadavg()), flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(program(main)())
