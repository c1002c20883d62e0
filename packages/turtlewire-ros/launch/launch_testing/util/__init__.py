"""Finds processes; a process that keeps a launch alive."""

from __future__ import annotations

import sys

from launch.actions import ExecuteProcess
from launch_testing.util.proc_lookup import (
    NO_CMD_ARGS,
    NoMatchingProcessException,
    resolveProcesses,
)

__all__ = ["NO_CMD_ARGS", "KeepAliveProc", "NoMatchingProcessException", "resolveProcesses"]

# Ends at the first interrupt, without a traceback. Windows has no `pause`.
_WAIT = "import signal; signal.signal(2, lambda *_: exit()); signal.pause()"
_WAIT_ON_WINDOWS = "import sys; sys.stdin.read()"


def KeepAliveProc() -> ExecuteProcess:  # noqa: N802  ROS 2's name
    """Return an action whose process waits until it is interrupted."""
    program = _WAIT_ON_WINDOWS if sys.platform == "win32" else _WAIT
    return ExecuteProcess(cmd=[sys.executable, "-c", program], name="keep_alive")
