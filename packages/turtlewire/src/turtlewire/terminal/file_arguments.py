"""Arguments that name files: completion in the shell, and errors in one line."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import argparse
    from collections.abc import Callable

__all__ = ["complete_bags", "complete_files", "reporting_errors"]


def complete_files(prefix: str, **_: Any) -> list[str]:
    """For the shell: files and folders."""
    return _complete(prefix, ())


def complete_bags(prefix: str, **_: Any) -> list[str]:
    """For the shell: bags and folders."""
    return _complete(prefix, ("mcap", "db3", "zstd"))


def _complete(prefix: str, endings: tuple[str, ...]) -> list[str]:
    from argcomplete.completers import FilesCompleter

    return list(FilesCompleter(allowednames=endings)(prefix))


def reporting_errors(
    command: str, run: Callable[[argparse.Namespace], int]
) -> Callable[[argparse.Namespace], int]:
    """Return the function, but what it cannot read is one line on stderr and the exit status 2."""

    def guarded(args: argparse.Namespace) -> int:
        from turtlewire.errors import BagError, TransformException
        from turtlewire.terminal.printable import printable_lines

        try:
            return run(args)
        except (BagError, TransformException, ModuleNotFoundError, OSError, ValueError) as error:
            text = _text_of(error)
            if hint := getattr(error, "hint", ""):
                text = f"{text}{'' if text.rstrip().endswith('.') else '.'} {hint}"
            print(f"turtlewire {command}: {printable_lines(text)}", file=sys.stderr)
            return 2

    return guarded


def _text_of(error: Exception) -> str:
    """Return the error's text; of the system's errors without their number."""
    if isinstance(error, OSError) and error.strerror and error.filename:
        return f"{error.filename}: {error.strerror}"
    return str(error)
