"""What a CMakeLists.txt installs, if all it does is to install files: no CMake is needed for that.

Packages with launch files, robot descriptions and meshes are of this kind: they call
``find_package``, ``install`` and ``ament_package``. Anything else is left to CMake.
"""

from __future__ import annotations

import re
from fnmatch import fnmatch
from pathlib import Path, PurePosixPath
from shutil import copyfile, copymode
from typing import NamedTuple

__all__ = ["Install", "install_files", "read_installs"]

#: Commands without an effect on what is installed.
_HARMLESS = frozenset(
    {
        "cmake_minimum_required",
        "find_package",
        "ament_package",
        "ament_export_dependencies",
        "message",
    }
)
_COMMAND = re.compile(r"\s*([A-Za-z_]\w*)\s*\(((?:\"(?:[^\"\\]|\\.)*\"|[^()\"])*)\)")
_COMMENT = re.compile(r"#\[\[.*?\]\]|#[^\n]*", re.DOTALL)
_WORD = re.compile(r"\"((?:[^\"\\]|\\.)*)\"|([^\s;\"]+)")
_KINDS = frozenset({"DIRECTORY", "FILES", "PROGRAMS"})
_VARIABLES = ("PROJECT_NAME", "CMAKE_PROJECT_NAME")


class Install(NamedTuple):
    """One ``install`` command.

    Attributes:
        kind: ``DIRECTORY``, ``FILES`` or ``PROGRAMS``.
        sources: Paths relative to the package. A directory that ends with ``/`` stands for its
            contents.
        destination: Where they go, relative to the prefix.
        excluded: Patterns of file names that stay behind.
    """

    kind: str
    sources: tuple[str, ...]
    destination: str
    excluded: tuple[str, ...] = ()


def read_installs(text: str) -> list[Install] | None:
    """The ``install`` commands of a CMakeLists.txt; None if it does anything else.

    What stands between ``if(BUILD_TESTING)`` and its ``endif()`` is skipped.
    """
    name = ""
    installs: list[Install] = []
    testing = 0
    position = 0
    text = _COMMENT.sub("", text)
    while text[position:].strip():
        match = _COMMAND.match(text, position)
        if match is None:
            return None
        position = match.end()
        command = match[1].lower()
        words = [plain or quoted for quoted, plain in _WORD.findall(match[2])]
        if testing:
            testing += {"if": 1, "endif": -1}.get(command, 0)
        elif command == "if" and words == ["BUILD_TESTING"]:
            testing = 1
        elif command == "project" and words:
            name = words[0]
        elif command == "install":
            install = _read_install(_expand(words, name))
            if install is None:
                return None
            installs.append(install)
        elif command not in _HARMLESS:
            return None
    return installs


def _expand(words: list[str], project: str) -> list[str]:
    for variable in _VARIABLES:
        words = [word.replace(f"${{{variable}}}", project) for word in words]
    return [word.removeprefix("${CMAKE_CURRENT_SOURCE_DIR}/") for word in words]


def _read_install(words: list[str]) -> Install | None:
    """The command of these words; None if they mean more than copying files inside the prefix."""
    if len(words) < 4 or words[0] not in _KINDS or words.count("DESTINATION") != 1:
        return None
    at = words.index("DESTINATION")
    options = words[at + 2 :]
    excluded = tuple(options[1::3])
    if options != [word for pattern in excluded for word in ("PATTERN", pattern, "EXCLUDE")]:
        return None
    paths = [*words[1:at], *words[at + 1 : at + 2]]
    if at < 2 or len(paths) != at or not all(_stays_inside(path) for path in paths):
        return None
    return Install(words[0], tuple(words[1:at]), words[at + 1], excluded)


def _stays_inside(path: str) -> bool:
    pure = PurePosixPath(path)
    return not pure.is_absolute() and ".." not in pure.parts and not set("$*<>") & set(path)


def install_files(installs: list[Install], source: Path, prefix: Path) -> None:
    """Copy what ``installs`` name from the package in ``source`` below ``prefix``.

    Raises:
        OSError: A file is missing or cannot be copied.
    """
    for install in installs:
        target = prefix / install.destination
        for name in install.sources:
            path = source / name
            if install.kind == "DIRECTORY":
                inner = target if name.endswith("/") else target / path.name
                _copy_directory(path, inner, install.excluded)
            else:
                _copy(path, target / path.name)
                if install.kind == "PROGRAMS":
                    (target / path.name).chmod(0o755)


def _copy_directory(source: Path, target: Path, excluded: tuple[str, ...]) -> None:
    target.mkdir(parents=True, exist_ok=True)
    for path in sorted(source.iterdir()):
        if any(fnmatch(path.name, pattern) for pattern in excluded):
            continue
        if path.is_dir():
            _copy_directory(path, target / path.name, excluded)
        else:
            _copy(path, target / path.name)


def _copy(source: Path, target: Path) -> None:
    target.parent.mkdir(parents=True, exist_ok=True)
    copyfile(source, target)
    copymode(source, target)
