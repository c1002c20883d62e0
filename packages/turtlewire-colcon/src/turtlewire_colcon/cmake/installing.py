"""The command ``install``."""

from __future__ import annotations

import fnmatch
import os
import re
from itertools import pairwise
from pathlib import PurePosixPath
from typing import TYPE_CHECKING

from turtlewire_colcon.cmake.plan import FileRule, Install
from turtlewire_colcon.cmake.syntax import CMakeError, parse_keywords

if TYPE_CHECKING:
    from turtlewire_colcon.cmake.interpreter import ExpandedCommand, Handler, Interpreter

__all__ = ["INSTALLING", "destination"]

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


INSTALLING: dict[str, Handler] = {"install": _install}
