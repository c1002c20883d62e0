"""CMake's commands about files: ``file``, ``configure_file``, ``install`` and the like."""

from __future__ import annotations

import fnmatch
import os
import re
from collections.abc import Callable
from itertools import pairwise
from pathlib import Path, PurePosixPath
from shutil import copyfile, copytree
from typing import TYPE_CHECKING

from turtlewire_colcon.cmake.basics import configured
from turtlewire_colcon.cmake.plan import FileRule, Install
from turtlewire_colcon.cmake.syntax import CMakeError, parse_keywords

if TYPE_CHECKING:
    from turtlewire_colcon.cmake.interpreter import ExpandedCommand, Handler, Interpreter

__all__ = ["FILES", "destination"]

_KINDS = ("DIRECTORY", "FILES", "PROGRAMS")
#: Forms for compiled targets, which do not exist here.
_WITHOUT_EFFECT = frozenset({"TARGETS", "EXPORT", "IMPORTED_RUNTIME_ARTIFACTS"})
_PERMISSIONS = ("PERMISSIONS", "FILE_PERMISSIONS", "DIRECTORY_PERMISSIONS", "CONFIGURATIONS")
_TYPES = {
    "BIN": "bin",
    "SBIN": "sbin",
    "LIB": "lib",
    "INCLUDE": "include",
    "DATA": "share",
    "DOC": "share/doc",
    "MAN": "share/man",
    "INFO": "share/info",
}


def _file(run: Interpreter, call: ExpandedCommand) -> None:
    action, *words = call.words
    if action in _WRITING:
        _WRITING[action](run, words, call)
    elif action in ("GLOB", "GLOB_RECURSE"):
        _glob(run, words, recursive=action == "GLOB_RECURSE")
    elif action in ("READ", "STRINGS"):
        text = Path(run.source_path(words[0])).read_text(encoding="utf-8", errors="replace")
        run.variables[words[1]] = text if action == "READ" else ";".join(text.splitlines())
    elif action == "RELATIVE_PATH":
        run.variables[words[0]] = os.path.relpath(words[2], words[1])
    elif action in ("TO_CMAKE_PATH", "TO_NATIVE_PATH"):
        run.variables[words[1]] = words[0]
    elif action == "REAL_PATH":
        run.variables[words[1]] = os.path.realpath(run.source_path(words[0]))
    else:
        raise CMakeError(call.place, f"file({action}) is not known here")


def _write(run: Interpreter, words: list[str], call: ExpandedCommand) -> None:
    path = _writable(run, words[0], call)
    with path.open("w" if call.words[0] == "WRITE" else "a", encoding="utf-8") as file:
        file.write("".join(words[1:]))


def _generate(run: Interpreter, words: list[str], call: ExpandedCommand) -> None:
    parsed = parse_keywords(words, values=("OUTPUT", "CONTENT", "INPUT"))
    path = _writable(run, parsed.values["OUTPUT"], call)
    if "INPUT" in parsed.values:
        copyfile(run.source_path(parsed.values["INPUT"]), path)
    else:
        path.write_text(parsed.values["CONTENT"], encoding="utf-8")


def _make_directory(run: Interpreter, words: list[str], call: ExpandedCommand) -> None:
    for word in words:
        _writable(run, word, call).mkdir(exist_ok=True)


def _glob(run: Interpreter, words: list[str], *, recursive: bool) -> None:
    variable, *rest = words
    parsed = parse_keywords(
        rest,
        options=("CONFIGURE_DEPENDS", "FOLLOW_SYMLINKS"),
        values=("RELATIVE", "LIST_DIRECTORIES"),
    )
    found: set[str] = set()
    for pattern in parsed.rest:
        folder, _, name = run.source_path(pattern).rpartition("/")
        # CMake also allows wildcards in folder names; glob starts above the first one.
        paths = Path(folder).rglob(name) if recursive else _matches(folder, name)
        found.update(str(path) for path in paths if not recursive or path.is_file())
    base = parsed.values.get("RELATIVE")
    listed = sorted(found)
    run.variables[variable] = ";".join(
        os.path.relpath(path, run.source_path(base)) if base else path for path in listed
    )


def _matches(folder: str, name: str) -> list[Path]:
    root = Path(folder)
    parts = [name]
    while set("*?[") & set(str(root)):
        parts.insert(0, root.name)
        root = root.parent
    return list(root.glob("/".join(parts)))


def _writable(run: Interpreter, text: str, call: ExpandedCommand) -> Path:
    """Return the path of a file to write; its folder exists afterwards."""
    path = Path(run.binary_path(text))
    folders = (run.variables["CMAKE_BINARY_DIR"], run.variables["CMAKE_INSTALL_PREFIX"])
    if not any(path.is_relative_to(folder) for folder in folders):
        raise CMakeError(call.place, f"{path} is not in the build folder, and is not written")
    path.parent.mkdir(parents=True, exist_ok=True)
    return path


def _copy(run: Interpreter, words: list[str], call: ExpandedCommand) -> None:
    parsed = parse_keywords(words, values=("DESTINATION",))
    target = _writable(run, os.path.join(parsed.values["DESTINATION"], "."), call)
    target.mkdir(exist_ok=True)
    for word in parsed.rest:
        source = Path(run.source_path(word))
        if source.is_dir():
            copytree(source, target / source.name, dirs_exist_ok=True)
        else:
            copyfile(source, target / source.name)


_WRITING: dict[str, Callable[[Interpreter, list[str], ExpandedCommand], None]] = {
    "WRITE": _write,
    "APPEND": _write,
    "GENERATE": _generate,
    "MAKE_DIRECTORY": _make_directory,
    "COPY": _copy,
}


def _configure_file(run: Interpreter, call: ExpandedCommand) -> None:
    source = Path(run.source_path(call.words[0]))
    target = _writable(run, call.words[1], call)
    if target.is_dir():
        target /= source.name
    if not source.is_file():
        raise CMakeError(call.place, f"configure_file(): there is no file {source}")
    if "COPYONLY" in call.words:
        copyfile(source, target)
        return
    text = source.read_text(encoding="utf-8")
    target.write_text(configured(run, text, at_only="@ONLY" in call.words), encoding="utf-8")


def _get_filename_component(run: Interpreter, call: ExpandedCommand) -> None:
    variable, text, mode = call.words[:3]
    parsed = parse_keywords(call.words[3:], options=("CACHE",), values=("BASE_DIR",))
    base = parsed.values.get("BASE_DIR") or run.variables["CMAKE_CURRENT_SOURCE_DIR"]
    name = os.path.basename(text)
    stem, dot, extension = name.partition(".")
    modes = {
        "DIRECTORY": os.path.dirname(text),
        "PATH": os.path.dirname(text),
        "NAME": name,
        "NAME_WE": stem,
        "NAME_WLE": os.path.splitext(name)[0],
        "EXT": dot + extension,
        "LAST_EXT": os.path.splitext(name)[1],
        "ABSOLUTE": os.path.normpath(os.path.join(base, text)),
        "REALPATH": os.path.realpath(os.path.join(base, text)),
    }
    run.variables[variable] = modes[mode]


def _include(run: Interpreter, call: ExpandedCommand) -> None:
    name = call.words[0]
    path = run.source_path(name)
    if os.path.isfile(path):
        run.run_file(path)
        return
    for folder in run.variables.get("CMAKE_MODULE_PATH", "").split(";"):
        module = os.path.join(run.source_path(folder), f"{name}.cmake")
        if folder and os.path.isfile(module):
            run.run_file(module)
            return
    # Modules of CMake itself begin with a capital letter, and what matters of them here is defined
    # beforehand.
    if (name.endswith(".cmake") or not name[0].isupper()) and "OPTIONAL" not in call.words:
        kind = "file" if name.endswith(".cmake") else "module in CMAKE_MODULE_PATH and no file"
        raise CMakeError(call.place, f"include(): there is no {kind} {path}")


def _add_subdirectory(run: Interpreter, call: ExpandedCommand) -> None:
    folder = run.source_path(call.words[0])
    path = os.path.join(folder, "CMakeLists.txt")
    if not os.path.isfile(path):
        raise CMakeError(call.place, f"add_subdirectory(): there is no file {path}")
    binary = run.binary_path(os.path.relpath(folder, run.source_path(".")))
    with run.scope(CMAKE_CURRENT_SOURCE_DIR=folder, CMAKE_CURRENT_BINARY_DIR=binary):
        run.run_file(path)


def _install(run: Interpreter, call: ExpandedCommand) -> None:
    kind = call.words[0] if call.words else ""
    if kind in _WITHOUT_EFFECT:
        return
    if kind == "CODE":
        run.plan.install_code.append((call.words[1], call.place))
        return
    if kind not in _KINDS:
        raise CMakeError(call.place, f"install({kind}) is not known here")
    words, rules = (
        _split_rules(call.words[1:], call) if kind == "DIRECTORY" else (call.words[1:], [])
    )
    parsed = parse_keywords(
        words,
        options=(
            "OPTIONAL",
            "USE_SOURCE_PERMISSIONS",
            "FILES_MATCHING",
            "MESSAGE_NEVER",
            "EXCLUDE_FROM_ALL",
        ),
        values=("DESTINATION", "RENAME", "COMPONENT", "TYPE"),
        lists=_PERMISSIONS,
    )
    target = parsed.values.get("DESTINATION") or _TYPES.get(parsed.values.get("TYPE", ""))
    if target is None:
        raise CMakeError(call.place, f"install({kind}) has no DESTINATION")
    run.plan.installs.append(
        Install(
            kind,
            tuple(_source(run, word) for word in parsed.rest),
            destination(run, target, call),
            call.place,
            parsed.values.get("RENAME", ""),
            "OPTIONAL" in parsed.options,
            tuple(rules),
            "FILES_MATCHING" in parsed.options,
        )
    )


def destination(run: Interpreter, text: str, call: ExpandedCommand) -> str:
    """Return a folder of the prefix, relative to it.

    Raises:
        CMakeError: The destination is outside the prefix.
    """
    prefix = run.variables["CMAKE_INSTALL_PREFIX"]
    relative = os.path.relpath(text, prefix) if os.path.isabs(text) else os.path.normpath(text)
    if PurePosixPath(relative).parts[:1] == ("..",):
        raise CMakeError(call.place, f"the destination {text} is outside of the install folder")
    return relative


def _source(run: Interpreter, word: str) -> str:
    # A trailing slash means the contents of the folder.
    return run.source_path(word) + ("/" if word.endswith("/") or word in (".", "") else "")


def _split_rules(words: list[str], call: ExpandedCommand) -> tuple[list[str], list[FileRule]]:
    """Return the words before the first ``PATTERN`` or ``REGEX``, and these rules."""
    starts = [at for at, word in enumerate(words) if word in ("PATTERN", "REGEX")]
    rules = []
    for start, end in pairwise([*starts, len(words)]):
        if end < start + 2:
            raise CMakeError(call.place, f"install(): {words[start]} needs a value")
        keyword, text, *options = words[start:end]
        if keyword == "PATTERN":
            text = "/" + fnmatch.translate(text)
        try:
            re.compile(text)
        except re.error as error:
            raise CMakeError(call.place, f"install(): REGEX {text!r}: {error}") from None
        rules.append(FileRule(text, "EXCLUDE" in options))
    return words[: starts[0]] if starts else words, rules


FILES: dict[str, Handler] = {
    "install": _install,
    "file": _file,
    "configure_file": _configure_file,
    "get_filename_component": _get_filename_component,
    "include": _include,
    "add_subdirectory": _add_subdirectory,
}
