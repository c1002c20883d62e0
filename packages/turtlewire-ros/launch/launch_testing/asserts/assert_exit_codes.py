"""An assertion about the exit codes of processes."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from launch.events.process import ProcessExited
from launch_testing.util.proc_lookup import resolveProcesses

if TYPE_CHECKING:
    from launch_testing.proc_info_handler import ActiveProcInfoHandler, ProcInfoHandler

__unittest = True  # unittest leaves this module out of the tracebacks of failures

# ROS 2's numbers: a signal's number plus 128, as a shell reports it.
EXIT_OK = 0
EXIT_FORCED = 1
EXIT_SIGINT = 130
EXIT_SIGQUIT = 131
EXIT_SIGKILL = 137
EXIT_SIGSEGV = 139


def assertExitCodes(  # noqa: N802  ROS 2's name
    proc_info: ProcInfoHandler | ActiveProcInfoHandler,
    allowable_exit_codes: Iterable[int] = [EXIT_OK],
    process: Any = None,
    cmd_args: Any = None,
    *,
    strict_proc_matching: bool = True,
) -> None:
    """Assert that processes ended with one of some exit codes.

    A process that a signal ended has the negative number of the signal.

    Args:
        proc_info: The records.
        allowable_exit_codes: The codes.
        process: An action, a part of a name, or None for all processes.
        cmd_args: As for :func:`launch_testing.util.resolveProcesses`.
        strict_proc_matching: Likewise.

    Raises:
        AssertionError: A process ended with another code, or still runs.
        NoMatchingProcessException: No process matches.
    """
    allowed = list(allowable_exit_codes)
    for code in allowed:
        if not isinstance(code, int):
            raise TypeError(f"exit codes are int, not {type(code).__name__} ({code!r})")
    for action in resolveProcesses(
        proc_info, process=process, cmd_args=cmd_args, strict_proc_matching=strict_proc_matching
    ):
        event = proc_info[action]
        assert isinstance(event, ProcessExited), f"Proc {event.process_name} has not ended"
        assert event.returncode in allowed, (
            f"Proc {event.process_name} exited with code {event.returncode}"
        )
