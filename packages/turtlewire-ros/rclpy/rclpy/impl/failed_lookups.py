"""Shortens repeated log lines about failed transform lookups on the console.

A program logs ``f"Could not transform: {error}"`` where it handles the error, often ten times a
second. The console gets such a line once a second, with the hint of the error below it. The log
file and ``/rosout`` get each line as it was logged.
"""

from __future__ import annotations

import sys
from time import monotonic_ns
from typing import NamedTuple

from turtlewire.errors import TransformException

_PERIOD_NS = 1_000_000_000
#: Errors that one line of a program reported, above which the oldest are forgotten.
_MOST_ERRORS = 100


class Shown(NamedTuple):
    """The part of a log line that the console shows.

    Attributes:
        line: Whether it shows the line.
        help: A further line below it; may be empty.
    """

    line: bool = True
    help: str = ""


class _Report(NamedTuple):
    shown_ns: int
    left_out: int = 0


#: The line alone.
WHOLE = Shown()


class FailedLookups:
    """The failed lookups that one line of a program reported. Not thread-safe."""

    def __init__(self) -> None:
        self._reports: dict[tuple[type, str], _Report] = {}

    def shown(self, message: str) -> Shown:
        """Decide what the console shows of a message.

        Only messages that contain the text of the error that is being handled are held back.
        """
        error = sys.exc_info()[1]
        if not isinstance(error, TransformException) or str(error) not in message:
            return WHOLE
        now = monotonic_ns()
        key = (type(error), str(getattr(error, "frame", "")))
        last = self._reports.pop(key, None)
        if last is not None and now < last.shown_ns + _PERIOD_NS:
            self._reports[key] = last._replace(left_out=last.left_out + 1)
            return Shown(line=False)
        # At the end of the dictionary, which is in the order of the last reports.
        self._reports[key] = _Report(now)
        if len(self._reports) > _MOST_ERRORS:
            del self._reports[next(iter(self._reports))]
        again = f"({last.left_out} more of these since the last.)" if last and last.left_out else ""
        return Shown(help=" ".join(filter(None, (error.hint, again))))
