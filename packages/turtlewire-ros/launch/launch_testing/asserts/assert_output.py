"""Assertions about the output of processes."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from launch_testing.tools.output import expected_text_matches
from launch_testing.util.proc_lookup import resolveProcesses

__unittest = True  # unittest leaves this module out of the tracebacks of failures


def assertInStdout(  # noqa: N802  ROS 2's name
    proc_output: Any,
    expected_output: Any,
    process: Any,
    cmd_args: Any = None,
    *,
    output_filter: Callable[[str], str] | None = None,
    strict_proc_matching: bool = True,
    strip_ansi_escape_sequences: bool = True,
) -> None:
    """Assert that a process wrote something to stdout; see :func:`assertInStream`."""
    assertInStream(
        proc_output,
        expected_output,
        process,
        cmd_args,
        output_filter=output_filter,
        strict_proc_matching=strict_proc_matching,
        strip_ansi_escape_sequences=strip_ansi_escape_sequences,
        stream="stdout",
    )


def assertInStderr(  # noqa: N802  ROS 2's name
    proc_output: Any,
    expected_output: Any,
    process: Any,
    cmd_args: Any = None,
    *,
    output_filter: Callable[[str], str] | None = None,
    strict_proc_matching: bool = True,
    strip_ansi_escape_sequences: bool = True,
) -> None:
    """Assert that a process wrote something to stderr; see :func:`assertInStream`."""
    assertInStream(
        proc_output,
        expected_output,
        process,
        cmd_args,
        output_filter=output_filter,
        strict_proc_matching=strict_proc_matching,
        strip_ansi_escape_sequences=strip_ansi_escape_sequences,
        stream="stderr",
    )


def assertInStream(  # noqa: N802  ROS 2's name
    proc_output: Any,
    expected_output: Any,
    process: Any,
    cmd_args: Any = None,
    *,
    output_filter: Callable[[str], str] | None = None,
    strict_proc_matching: bool = True,
    strip_ansi_escape_sequences: bool = True,
    stream: str = "stderr",
) -> None:
    """Assert that a process wrote something.

    Args:
        proc_output: The records.
        expected_output: A text, a pattern of :mod:`re`, or a list of them, which must come in
            that order; or a function that returns whether a string matches.
        process: An action, a part of a name, or None for all processes.
        cmd_args: As for :func:`launch_testing.util.resolveProcesses`.
        output_filter: Changes the text before the search.
        strict_proc_matching: As for :func:`launch_testing.util.resolveProcesses`.
        strip_ansi_escape_sequences: Whether colours and other sequences are removed before.
        stream: ``stdout`` or ``stderr``.

    Raises:
        AssertionError: No process wrote the text.
        NoMatchingProcessException: No process matches.
        ValueError: ``stream`` is another string, or ``output_filter`` cannot be called.
    """
    if stream not in ("stdout", "stderr"):
        raise ValueError(f"stream must be 'stdout' or 'stderr', not {stream!r}")
    if output_filter is not None and not callable(output_filter):
        raise ValueError(f"output_filter must be a function, not {output_filter!r}")
    actions = resolveProcesses(
        proc_output, process=process, cmd_args=cmd_args, strict_proc_matching=strict_proc_matching
    )
    for action in actions:
        text = _text(proc_output, action, stream)
        if expected_text_matches(
            text, expected_output, output_filter, strip=strip_ansi_escape_sequences
        ):
            return
    names = ", ".join(sorted(action.process_details["name"] for action in actions))
    raise AssertionError(
        f"Did not find '{expected_output}' in output for any of the matching processes: {names}"
    )


def _text(proc_output: Any, action: Any, stream: str) -> str:
    # Joined before it is decoded, because a chunk may end within a character.
    return b"".join(
        event.text
        for event in proc_output[action]
        if (event.from_stdout if stream == "stdout" else event.from_stderr)
    ).decode(errors="replace")
