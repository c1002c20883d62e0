"""A parser that suggests names for misspelt words, and options that commands share.

Arguments that name files are completed in the shell, and their errors are one line.
"""

from __future__ import annotations

import argparse
import math
import re
import sys
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

from turtlewire.terminal.suggestion import did_you_mean

if TYPE_CHECKING:
    from typing import NoReturn

#: argparse's message about a word that is not one of the known ones.
INVALID_CHOICE = re.compile(r"invalid choice: '([^']*)' \(choose from")
_UNRECOGNIZED = re.compile(r"unrecognized arguments: (\S+)")


class SuggestingParser(argparse.ArgumentParser):
    """A parser that adds the nearest known words to its error; no option may be shortened.

    Attributes:
        meant: Returns what a word means that is not a command, or an empty string.
    """

    meant: Callable[[str], str] = staticmethod(lambda _word: "")

    def __init__(self, **settings: Any) -> None:
        super().__init__(allow_abbrev=False, **settings)

    def parse_args(  # type: ignore[override]  # a namespace class of the caller's own is not needed
        self, args: Sequence[str] | None = None, namespace: None = None
    ) -> argparse.Namespace:
        """Parse like argparse, but name the command in errors about unknown options."""
        parsed, unknown = self.parse_known_args(args, namespace)
        if unknown:
            getattr(parsed, "parser", self).error(f"unrecognized arguments: {' '.join(unknown)}")
        return parsed

    def error(self, message: str) -> NoReturn:
        """Print the usage, the message and a suggestion; exit with status 2."""
        choice = INVALID_CHOICE.search(message)
        unknown = _UNRECOGNIZED.match(message)
        suggestion = ""
        if choice:
            known = re.findall(r"[\w-]+", message[choice.end() :])
            suggestion = self.meant(choice[1]) or did_you_mean(choice[1], known)
        elif unknown:
            suggestion = did_you_mean(unknown[1].partition("=")[0], self._option_string_actions)
        super().error(f"{message}\n{suggestion}".rstrip())


def seconds(text: str) -> float:
    """Return a duration on the command line, above 0 and up to an hour."""
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not 0.0 < value <= 3600.0:
        raise argparse.ArgumentTypeError(
            f"{text!r} is not a number of seconds, above 0 and up to 3600"
        )
    return value


def add_tf_topics(parser: argparse.ArgumentParser) -> None:
    """Add the options for topics of transforms, each of which may be repeated for a bag.

    `tf_topics` reads them.
    """
    parser.add_argument(
        "--topic",
        action="append",
        metavar="T",
        help="Topic of the transforms (default: /tf)",
    )
    parser.add_argument(
        "--static-topic",
        action="append",
        metavar="T",
        help="Topic of the static transforms (default: /tf_static)",
    )


def add_robot_topics(parser: argparse.ArgumentParser) -> None:
    """Add the options for the topics of one robot's transforms in a network."""
    parser.add_argument(
        "--topic",
        default="/tf",
        type=full_topic_name,
        metavar="T",
        help="Topic of the transforms (default: %(default)s)",
    )
    parser.add_argument(
        "--static-topic",
        default="/tf_static",
        type=full_topic_name,
        metavar="T",
        help="Topic of the static transforms (default: %(default)s)",
    )


def full_topic_name(text: str) -> str:
    """Return a topic on the command line, which has no namespace, with its leading slash."""
    return f"/{text.removeprefix('/')}"


def tf_topics(args: argparse.Namespace) -> tuple[str | list[str], str | list[str]]:
    """Return the topics of moving and of static transforms, by option or default."""
    return args.topic or "/tf", args.static_topic or "/tf_static"


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
        expected: The expected errors; by default errors of turtlewire, files and values.
    """

    def guarded(args: argparse.Namespace) -> int:
        from turtlewire.errors import TurtlewireError
        from turtlewire.terminal.printable import printable_lines

        caught = expected or (TurtlewireError, ModuleNotFoundError, OSError, ValueError)
        try:
            return run(args) or 0
        except caught as error:
            print(f"turtlewire {command}: {printable_lines(_text_of(error))}", file=sys.stderr)
            return 2

    return guarded


def _text_of(error: Exception) -> str:
    """Return the error's message; system errors lose their number."""
    from turtlewire.errors import TurtlewireError

    if isinstance(error, TurtlewireError):
        return error.in_one_line()
    if isinstance(error, OSError) and error.strerror:
        return f"{error.filename}: {error.strerror}" if error.filename else error.strerror
    return str(error)
