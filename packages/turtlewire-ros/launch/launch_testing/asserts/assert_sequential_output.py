"""An assertion about the order of texts in the output of a process."""

from __future__ import annotations

import contextlib
from collections.abc import Iterable, Iterator
from typing import Any

from launch_testing.util.proc_lookup import resolveProcesses

__unittest = True  # unittest leaves this module out of the tracebacks of failures


class SequentialTextChecker:
    """Finds texts in output, each behind the one that was found before.

    Args:
        output: The output: texts, one for each write.
    """

    def __init__(self, output: Iterable[str]) -> None:
        self._text = "".join(output)
        self._position = 0

    def assertInStdout(self, msg: str) -> None:  # noqa: N802  ROS 2's name
        """Find the next text; see :meth:`assertInText`."""
        self.assertInText(msg)

    def assertInText(self, msg: str) -> None:  # noqa: N802  ROS 2's name
        """Find a text behind all that were found before.

        Raises:
            AssertionError: The text is missing; the message shows the lines around the last match.
        """
        start = self._text.find(msg, self._position)
        if start < 0:
            raise AssertionError(
                f"'{msg}' not found in output. Last text found was near:\n"
                + "\n".join(self.get_nearby_lines())
            )
        self._position = start + len(msg)

    def get_nearby_lines(self) -> list[str]:
        """Return the lines around the end of what was found last."""
        before = self._text[: self._position].splitlines()
        after = self._text[self._position :].splitlines()
        return [*before[-5:], *after[:5]]


@contextlib.contextmanager
def assertSequentialStdout(  # noqa: N802  ROS 2's name
    proc_output: Any, process: Any, cmd_args: Any = None
) -> Iterator[SequentialTextChecker]:
    """Check texts in their order, in a ``with`` block.

    Args:
        proc_output: The records.
        process: An action or a part of a name.
        cmd_args: As for :func:`launch_testing.util.resolveProcesses`.

    Yields:
        The checker.

    Raises:
        NoMatchingProcessException: No process matches, or several do.
    """
    action = resolveProcesses(proc_output, process=process, cmd_args=cmd_args)[0]
    yield SequentialTextChecker(
        event.text.decode(errors="replace") for event in proc_output[action] if event.from_stdout
    )
