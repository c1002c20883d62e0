"""Arguments that name files: completion in the shell, and errors in one line."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import argparse
    from collections.abc import Callable

__all__ = ["complete_bags", "complete_files", "reporting_errors"]


def complete_files(prefix: str, **_: Any) -> list[str]:
    """Complete a word with files and folders."""
    return _complete(prefix, ())


def complete_bags(prefix: str, **_: Any) -> list[str]:
    """Complete a word with bags and folders."""
    return _complete(prefix, ("mcap", "db3", "zstd"))


def _complete(prefix: str, endings: tuple[str, ...]) -> list[str]:
    from argcomplete.completers import FilesCompleter

    return list(FilesCompleter(allowednames=endings)(prefix))


def reporting_errors(
    command: str,
    run: Callable[[argparse.Namespace], int | None],
    expected: tuple[type[Exception], ...] | None = None,
) -> Callable[[argparse.Namespace], int]:
    """Wrap ``run``: for an expected error, print one line on stderr and return 2.

    Args:
        command: The word after ``turtlewire``.
        run: Returns the exit status; None means 0.
        expected: The expected errors; by default errors of bags, files and transforms.
    """

    def guarded(args: argparse.Namespace) -> int:
        from turtlewire.errors import BagError, TransformException
        from turtlewire.terminal.printable import printable_lines

        caught = expected or (
            *(BagError, TransformException),
            *(ModuleNotFoundError, OSError, ValueError),
        )
        try:
            return run(args) or 0
        except caught as error:
            text = _text_of(error)
            if hint := getattr(error, "hint", ""):
                text = f"{text}{'' if text.rstrip().endswith('.') else '.'} {hint}"
            print(f"turtlewire {command}: {printable_lines(text)}", file=sys.stderr)
            return 2

    return guarded


def _text_of(error: Exception) -> str:
    """Return the error's message; system errors lose their number."""
    if isinstance(error, OSError) and error.strerror and error.filename:
        return f"{error.filename}: {error.strerror}"
    return str(error)
