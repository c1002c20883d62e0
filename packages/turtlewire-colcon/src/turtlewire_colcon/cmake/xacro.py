"""``xacro_add_files`` and its parts, which xacro's CMake extras define, unlike PyPI's xacro.

A xacro that is built in the workspace defines its own functions, which replace these.
"""

from __future__ import annotations

import os
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from turtlewire_colcon.cmake.plan import Install, Step
from turtlewire_colcon.cmake.syntax import CMakeError, parse_keywords

if TYPE_CHECKING:
    from turtlewire_colcon.cmake.interpreter import ExpandedCommand, Handler, Interpreter

__all__ = ["XACRO"]

_RUN_XACRO = "import xacro; xacro.main()"


def _add_xacro_file(run: Interpreter, call: ExpandedCommand) -> None:
    parsed = parse_keywords(call.words, values=("OUTPUT",), lists=("REMAP", "DEPENDS"))
    output = parsed.rest[1] if len(parsed.rest) > 1 else ""
    path = _expand_file(run, call, parsed.rest[0], output, parsed.lists.get("REMAP", []))
    run.variables[parsed.values.get("OUTPUT", "XACRO_OUTPUT_FILE")] = path


def _xacro_install(run: Interpreter, call: ExpandedCommand) -> None:
    parsed = parse_keywords(call.words[1:], values=("DESTINATION",))
    _install(run, call, parsed.rest, parsed.values.get("DESTINATION", ""))


def _add_files(run: Interpreter, call: ExpandedCommand) -> None:
    parsed = parse_keywords(
        call.words, ("INSTALL",), ("OUTPUT", "TARGET", "DESTINATION"), ("REMAP", "DEPENDS")
    )
    remap = parsed.lists.get("REMAP", [])
    given = parsed.values.get("OUTPUT", "")
    paths = [_expand_file(run, call, word, given, remap) for word in parsed.rest]
    if "INSTALL" in parsed.options:
        _install(run, call, paths, parsed.values.get("DESTINATION", ""))


def _expand_file(
    run: Interpreter, call: ExpandedCommand, name: str, output: str, remap: list[str]
) -> str:
    """Plan the expansion of a file; returns the path of the result."""
    source = Path(run.source_path(name))
    if not source.is_file():
        raise CMakeError(call.place, f"{call.name}(): there is no file {source}")
    if not output and not name.endswith(".xacro"):
        raise CMakeError(call.place, f"{call.name}({name}): name the output, or the file .xacro")
    path = run.binary_path(output or name.removesuffix(".xacro"))
    Path(path).parent.mkdir(parents=True, exist_ok=True)
    index = _index_of_sources(run)
    prefixes = os.pathsep.join(
        filter(None, (str(index), run.environment.get("AMENT_PREFIX_PATH", "")))
    )
    words = [sys.executable, "-m", "turtlewire_colcon.cmake.tool", "-E", "env"]
    words += [f"AMENT_PREFIX_PATH={prefixes}", sys.executable, "-c", _RUN_XACRO]
    folder = run.variables["CMAKE_CURRENT_SOURCE_DIR"]
    run.plan.steps.append(Step((*words, "-o", path, str(source), *remap), folder, call.place))
    return path


def _index_of_sources(run: Interpreter) -> Path:
    """Return a prefix in which ``$(find …)`` finds the package's sources before it is installed."""
    index = Path(run.variables["CMAKE_BINARY_DIR"]) / "ament_cmake_index"
    name = run.variables["PROJECT_NAME"]
    marker = index / "share" / "ament_index" / "resource_index" / "packages" / name
    marker.parent.mkdir(parents=True, exist_ok=True)
    marker.touch()
    share = index / "share" / name
    if not share.is_symlink():
        share.symlink_to(run.variables["CMAKE_SOURCE_DIR"])
    return index


def _install(run: Interpreter, call: ExpandedCommand, paths: list[str], folder: str) -> None:
    target = os.path.normpath(f"share/{run.variables['PROJECT_NAME']}/{folder}")
    run.plan.installs.append(Install("FILES", tuple(paths), target, call.place))


XACRO: dict[str, Handler] = {
    "xacro_add_xacro_file": _add_xacro_file,
    "xacro_install": _xacro_install,
    "xacro_add_files": _add_files,
}
