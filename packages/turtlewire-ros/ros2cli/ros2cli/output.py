"""Output of the verbs: text from other processes must not control the terminal."""

from __future__ import annotations

import contextlib
import sys
from collections.abc import Iterable, Iterator
from typing import Any

from turtlewire.errors import UncallableServiceError
from turtlewire.terminal.printable import printable_lines


def tell(text: str) -> None:
    """Print a message to stderr; what peers have put into it is escaped."""
    print(printable_lines(text), file=sys.stderr)


def tell_failed_call(node_name: str, error: RuntimeError, service: str = "") -> None:
    """Print ROS 2's message for a node that could not be asked, for verbs that ask all nodes.

    Args:
        node_name: Full name of the node.
        error: Why it could not be asked.
        service: Name of the service, if ROS 2 names it in this message.
    """
    reason = error.in_one_line() if isinstance(error, UncallableServiceError) else str(error)
    named = f"{service} service" if service else "service"
    tell(f"Exception while calling {named} of node '{node_name}': {reason}")


def print_set_results(parameters: Iterable[Any], results: Iterable[Any]) -> None:
    """Print whether parameters were set.

    Args:
        parameters: Messages with the names.
        results: ``rcl_interfaces/msg/SetParametersResult`` messages, as many.
    """
    for parameter, result in zip(parameters, results, strict=True):
        reason = f": {result.reason}" if result.reason else ""
        if result.successful:
            print(f"Set parameter {parameter.name} successful{reason}")
        else:
            tell(f"Set parameter {parameter.name} failed{reason}")


def clear_terminal() -> None:
    """Clear the terminal and put the cursor into its first line, although stdout is escaped."""
    # Without the line feed that would flush a pipe.
    print("\x1b[H\x1b[2J", end="", file=getattr(sys.stdout, "unescaped", None), flush=True)


class _EscapingStream:
    """A text stream that escapes control characters other than line feeds and tabs.

    Its attribute ``unescaped`` is the stream below it.
    """

    def __init__(self, stream: Any) -> None:
        self.unescaped = stream

    def write(self, text: str) -> int:
        """Write the escaped text; returns the length of ``text``."""
        self.unescaped.write(printable_lines(text))
        return len(text)

    def __getattr__(self, name: str) -> Any:
        return getattr(self.unescaped, name)


@contextlib.contextmanager
def escaped_output() -> Iterator[None]:
    """Escape stdout within this context: names, strings and log lines may come from any peer."""
    stream = sys.stdout
    # Python leaves it None if it was closed at the start.
    if stream is None:
        yield
        return
    sys.stdout = _EscapingStream(stream)
    try:
        yield
    finally:
        sys.stdout = stream
