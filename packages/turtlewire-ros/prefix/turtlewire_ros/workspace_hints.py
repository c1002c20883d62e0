"""Hints about a colcon workspace: what is built and not sourced, or written and not installed."""

from __future__ import annotations

import os
import re
import shlex
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

from turtlewire import package_sources
from turtlewire.terminal.suggestion import did_you_mean
from turtlewire_ros.executables import executable_paths
from turtlewire_ros.prefix import MARKERS, compiled_targets, package_names, package_prefix
from turtlewire_ros.rqt import equivalent

#: colcon leaves this file in the folder of what it installs.
_LAYOUT = ".colcon_install_layout"
#: How deep below `src` packages are looked for.
_DEPTH = 4
#: Packages of ROS 2's tutorials, and what has their executables here.
_OTHER_NAMES = dict.fromkeys(
    ("learning_tf2_cpp", "turtle_tf2", "turtle_tf2_cpp", "turtle_tf2_py"), "learning_tf2_py"
)
#: A misspelt package is at least so similar to the real one. 'my_turtle' and 'turtlesim' are not.
_SIMILARITY = 0.8


def package_hint(package: str) -> str:
    """Say why a package is not found: not sourced, not built, misspelt or of another name.

    Workspaces are looked for in the current folder, its parents and the folders in it; about one
    that is elsewhere, the hint says how to source it.
    """
    if hint := source_hint(package):
        return hint
    other = _OTHER_NAMES.get(package)
    if other and package_prefix(other):
        return f"The nodes of this tutorial are here in the package {other}"
    return (
        equivalent(package)
        or did_you_mean(package, package_names(), _SIMILARITY)
        or "If it is in a workspace of yours, source the install/setup.bash there, after "
        "colcon build"
    )


def source_hint(package: str) -> str:
    """Say where the source of a package that is not installed is: in a workspace, or on the web.

    The string is empty if unknown.
    """
    for workspace in _workspaces():
        if hint := _not_sourced(workspace, package) or _not_built(workspace, package):
            return hint
    return package_sources.source_hint(package)


def executable_hint(package: str, executable: str) -> str:
    """Say why a package has no such executable; empty if unknown.

    It may be compiled from C++, not installed, or misspelt.
    """
    compiled = compiled_targets(package)
    if executable in compiled:
        return (
            f"{executable} is a C++ program, which turtlewire does not compile. Run it on a "
            "computer with ROS 2: its nodes and yours discover each other"
        )
    script = Path(package_prefix(package) or os.devnull, "bin", executable)
    if script.is_file():
        return (
            f"`ros2 run` does not find {_shown(script)}. setup.cfg needs, below "
            f"[install]: install_scripts=$base/lib/{package}"
        )
    source = _source_of_installed(package)
    if source and (hint := _executable_in(source, executable)):
        return hint
    known = [os.path.basename(path) for path in executable_paths(package) or []]
    return did_you_mean(executable, [*known, *compiled])


def file_hint(package: str, name: str) -> str:
    """Say that a file of a package is in its source and not installed; empty if it is not."""
    source = _source_of_installed(package)
    path = source and source.find({name})
    if not source or not path:
        return ""
    folder = f"share/{package}/{path.parent.as_posix()}".removesuffix("/.")
    if source.uses_cmake:
        return source.not_installed(
            path, f"install(DIRECTORY {path.parent.as_posix()} DESTINATION share/${{PROJECT_NAME}})"
        )
    return source.not_installed(path, f"('{folder}', ['{path.as_posix()}']) in data_files")


def path_hint(path: str) -> str:
    """`file_hint` for a path that ends with ``share/PACKAGE/…``; empty for others."""
    before, share, rest = path.replace(os.sep, "/").rpartition("/share/")
    package, slash, _ = rest.partition("/")
    return file_hint(package, os.path.basename(path)) if before and share and slash else ""


class _Source(NamedTuple):
    """The source of a package, in a workspace that colcon has built."""

    package: str
    folder: Path
    workspace: Path

    @property
    def uses_cmake(self) -> bool:
        return (self.folder / "CMakeLists.txt").is_file()

    def find(self, names: set[str]) -> Path | None:
        """Return the path of the first file with one of the names, relative to the folder."""
        found = sorted(path for path in self.folder.rglob("*") if path.name in names)
        return found[0].relative_to(self.folder) if found else None

    def not_installed(self, path: Path, rule: str) -> str:
        """Say that a file is not installed, and which rule in the package's set-up installs it."""
        place = "CMakeLists.txt" if self.uses_cmake else "setup.py"
        return (
            f"{_shown(self.folder / path)} exists, but it is not installed. {place} needs {rule}; "
            f"then type: {_build(self.package, self.workspace)}"
        )


def _workspaces() -> Iterator[Path]:
    try:
        here = Path.cwd()
        below = sorted(folder for folder in here.iterdir() if (folder / "src").is_dir())
    except OSError:  # the current folder was removed, or may not be read
        return
    yield from (here, *here.parents, *below)


def _not_sourced(workspace: Path, package: str) -> str:
    install = workspace / "install"
    if not (install / _LAYOUT).is_file():
        return ""
    for prefix in (install / package, install):
        marker = prefix / MARKERS / package
        if marker.is_symlink() and not marker.exists():  # `--symlink-install` writes full paths
            return (
                f"'{package}' is built in {_shown(install)}, but its links lead to files that do "
                "not exist: the workspace was moved, or build was removed. Type: "
                f"{_enter(workspace)}rm -rf build install && colcon build --symlink-install && "
                "source install/setup.bash"
            )
        if marker.is_file():
            return (
                f"'{package}' is built in {_shown(install)}, but this shell does not know it: "
                f"source {_quoted(install / 'setup.bash')}"
            )
        if (prefix / "share" / package / "package.xml").is_file():
            return (
                f"'{package}' is built in {_shown(install)}, but not registered: data_files of "
                "setup.py needs "
                f"('share/ament_index/resource_index/packages', ['resource/{package}'])"
            )
    return ""


def _not_built(workspace: Path, package: str) -> str:
    source = _source_below(workspace / "src", package)
    if source is None:
        return ""
    return (
        f"'{package}' is in {_shown(source)}, but it is not built: {_build(package, workspace)} "
        "&& source install/setup.bash"
    )


def _executable_in(source: _Source, executable: str) -> str:
    """Say what keeps an executable that the source has from being found; empty if it has none."""
    setup = source.folder / "setup.py"
    text = setup.read_text(encoding="utf-8", errors="replace") if setup.is_file() else ""
    if re.search(rf"""["']\s*{re.escape(executable)}\s*=""", text):
        return (
            f"{_shown(setup)} names '{executable}', but the installed package is older. Type: "
            f"{_build(source.package, source.workspace)}"
        )
    path = source.find({executable, f"{executable}.py"})
    if path is None:
        return ""
    if source.uses_cmake:
        rule = f"install(PROGRAMS {path.as_posix()} DESTINATION lib/${{PROJECT_NAME}})"
    else:
        module = ".".join(path.with_suffix("").parts)
        rule = f"'{path.stem} = {module}:main' in console_scripts"
    return source.not_installed(path, rule)


def _source_of_installed(package: str) -> _Source | None:
    """Return the source of a package that colcon installed, or None."""
    prefix = package_prefix(package)
    if prefix is None:
        return None
    for install in (Path(prefix), Path(prefix).parent):  # with --merge-install, and without
        if (install / _LAYOUT).is_file():
            folder = _source_below(install.parent, package)
            return None if folder is None else _Source(package, folder, install.parent)
    return None


def _source_below(top: Path, package: str) -> Path | None:
    """Return the folder with the source of a package, or None."""
    for base, folders, files in os.walk(top):
        if "COLCON_IGNORE" in files:
            folders.clear()
        elif "package.xml" in files:
            folders.clear()  # colcon looks for no package within a package
            manifest = Path(base, "package.xml").read_text(encoding="utf-8", errors="replace")
            if re.search(rf"<name>\s*{re.escape(package)}\s*</name>", manifest):
                return Path(base)
        elif len(Path(base).relative_to(top).parts) >= _DEPTH:
            folders.clear()
        folders[:] = sorted(name for name in folders if not name.startswith("."))
    return None


def _build(package: str, workspace: Path) -> str:
    """Return the commands that build a package."""
    return f"{_enter(workspace)}colcon build --packages-select {package}"


def _enter(workspace: Path) -> str:
    return "" if workspace == Path.cwd() else f"cd {_quoted(workspace)} && "


def _quoted(path: Path) -> str:
    return shlex.quote(_shown(path))


def _shown(path: Path) -> str:
    """Return the path as a user would type it: relative if it lies below the current folder."""
    here = Path.cwd()
    return str(path.relative_to(here)) if path.is_relative_to(here) else str(path)
