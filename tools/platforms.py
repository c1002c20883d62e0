"""Finds uses of functions, modules and files that Windows or macOS do not have.

mypy, run for each platform, finds functions that are missing there. This tool finds the
rest: modules that cannot be imported, and files and programs that are only named in strings.
"""

from __future__ import annotations

import ast
import sys
from collections.abc import Iterator
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))  # also where it is loaded by its path

from distributions import CLASS, COLCON, ENGINE, ROOT, ROS, import_path

FOLDERS = (*import_path(), ROOT / "examples")
#: Modules that Python has on POSIX only.
POSIX_MODULES = {
    *("curses", "fcntl", "grp", "posix", "pty", "pwd", "readline", "resource", "spwd"),
    *("syslog", "termios", "tty"),
}
#: Folders and programs that not every system has.
POSIX_PATHS = ("/bin/", "/dev/", "/etc/", "/proc/", "/sys/", "/tmp/", "/usr/", "/var/")
SHELLS = {"bash", "fish", "sh", "zsh"}
PREFIX = ROS / "prefix" / "turtlewire_ros"
COLCON_CODE = COLCON / "src" / "turtlewire_colcon"
#: Files in which such a string is right, and the reason.
REASONS = {
    ENGINE / "src/turtlewire/doctor/network.py": "does without where the file is missing",
    ENGINE / "src/turtlewire/doctor/fast_dds_findings.py": "does without what is missing",
    ENGINE / "src/turtlewire/wire/loopback.py": "reads it on Linux only",
    ENGINE / "src/turtlewire/wire/cyclone/ports.py": "does without where the file is missing",
    ENGINE / "src/turtlewire/wire/libddsc.py": "looks for folders, and finds none",
    COLCON_CODE / "cmake/processes.py": "redirected output needs a shell, as under make",
    COLCON_CODE / "plan_install.py": "writes the setup files of each shell",
    ROS / "ros2cli/ros2doctor/api/network.py": "does without where the file is missing",
    PREFIX / "process_guardian.py": "is started on Linux only",
    CLASS / "src/turtle_class/supervise.py": "its caller asks for Linux",
    COLCON_CODE / "wheel.py": "pip replaces the first line of a script",
}


def main() -> int:
    """Print what was found; the exit status."""
    found = sorted(
        f"{path.relative_to(ROOT)}:{line}: {text}"
        for folder in FOLDERS
        for path in folder.rglob("*.py")
        if "tests" not in path.relative_to(folder).parts
        for line, text in faults(path)
    )
    if found:
        print("\n".join(found))
        print("Guard it by `if sys.platform …`, or give the reason in tools/platforms.py.")
    return bool(found)


def faults(path: Path) -> Iterator[tuple[int, str]]:
    """Lines of a file that use what other platforms do not have."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    yield from _imports(tree.body)
    if path not in REASONS:
        yield from _strings(tree)


def _imports(body: list[ast.stmt]) -> Iterator[tuple[int, str]]:
    """Imports that run with the module; those in functions are guarded as mypy demands it."""
    for statement in body:
        if isinstance(statement, ast.Assert) and _asks_for_platform(statement.test):
            return
        names: list[str] = []
        if isinstance(statement, ast.Import):
            names = [alias.name for alias in statement.names]
        elif isinstance(statement, ast.ImportFrom):
            names = [statement.module or ""]
        yield from (
            (statement.lineno, f"there is no module {name} on Windows")
            for name in names
            if name.split(".")[0] in POSIX_MODULES
        )


def _strings(tree: ast.Module) -> Iterator[tuple[int, str]]:
    """Files and shells that are named outside of docstrings and guarded blocks."""
    guarded = _guarded(tree)
    for node in ast.walk(tree):
        if not isinstance(node, ast.Constant) or not isinstance(node.value, str):
            continue
        if id(node) not in guarded and (node.value.startswith(POSIX_PATHS) or node.value in SHELLS):
            yield node.lineno, f"{node.value!r} is not there on every system"


def _guarded(tree: ast.Module) -> set[int]:
    """The nodes below an ``if`` that asks for the platform, in a function that does, docstrings."""
    found: set[int] = set()
    for node in ast.walk(tree):
        asks = isinstance(node, ast.If | ast.IfExp) and _asks_for_platform(node.test)
        function = isinstance(node, ast.FunctionDef) and any(
            isinstance(inner, ast.If) and _asks_for_platform(inner.test) for inner in node.body
        )
        docstring = isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant)
        if asks or function or docstring:
            found.update(id(inner) for inner in ast.walk(node))
    if any(isinstance(one, ast.Assert) and _asks_for_platform(one.test) for one in tree.body):
        found.update(id(inner) for inner in ast.walk(tree))
    return found


def _asks_for_platform(test: ast.expr) -> bool:
    return any(
        isinstance(node, ast.Attribute)
        and node.attr in {"platform", "name"}
        and isinstance(node.value, ast.Name)
        and node.value.id in ("sys", "os")
        for node in ast.walk(test)
    )


if __name__ == "__main__":
    sys.exit(main())
