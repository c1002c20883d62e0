"""A script: the guardian of a :class:`~turtlewire_ros.process_family.ProcessFamily`.

It waits until its stdin ends, which happens when the process that started it ends, by SIGKILL too,
and then stops every process of the family. It runs next to each `ros2 run` and `ros2 launch`, so it
imports only what it needs to start fast and stay small.
"""

from __future__ import annotations

import os
import select
import signal
import sys
import time

#: Environment variable: the families that a process belongs to, outermost first, joined by colons.
FAMILIES = "TURTLEWIRE_FAMILIES"
#: Seconds between SIGTERM and SIGKILL, as in a launch.
_GRACE_S = 5.0
# A process that even SIGKILL does not end is blocked in the kernel; waiting longer is useless.
_KILL_ROUNDS = 3


def guard(family: str) -> None:
    """Wait for the end of stdin, then stop every process of the family."""
    if sys.platform != "linux":
        return
    while os.read(0, 1):
        pass
    _signal_and_wait(_members(family), signal.SIGTERM)
    for _ in range(_KILL_ROUNDS):  # a process may have started another one since the last look
        left = _members(family)
        if not left:
            return
        _signal_and_wait(left, signal.SIGKILL)


def _members(family: str) -> list[int]:
    """Return the processes of the family that have not ended."""
    # A process is missed if it begins while /proc is read, or if it has no environment because it
    # is executing another program. The family has ended when a second search also finds none.
    return _search(family) or _search(family)


def _search(family: str) -> list[int]:
    return [
        int(name) for name in os.listdir("/proc") if name.isdigit() and family in _families(name)
    ]


def _families(process: str) -> list[str]:
    head = f"{FAMILIES}=".encode()
    try:
        with open(f"/proc/{process}/environ", "rb") as file:
            variables = file.read().split(b"\0")
    except OSError:  # it has just ended, or belongs to another user
        return []
    for variable in variables:
        if variable.startswith(head):
            return variable.removeprefix(head).decode(errors="replace").split(":")
    return []


def _signal_and_wait(processes: list[int], number: signal.Signals) -> None:
    """Send a signal to processes, and wait until they have ended or the grace is over."""
    if sys.platform != "linux":
        return
    poller = select.poll()
    waiting = set()
    for process in processes:
        try:
            # A handle, because another process may reuse the id after this one has ended.
            handle = os.pidfd_open(process)
        except ProcessLookupError:
            continue
        waiting.add(handle)
        poller.register(handle, select.POLLIN)
        _send(handle, number)
        _send(handle, signal.SIGCONT)  # Ctrl-Z may have stopped it
    deadline = time.monotonic() + _GRACE_S
    while waiting and (left := deadline - time.monotonic()) > 0:
        for handle, _ in poller.poll(left * 1000):
            poller.unregister(handle)
            waiting.discard(handle)
            os.close(handle)
    for handle in waiting:
        os.close(handle)


def _send(handle: int, number: signal.Signals) -> None:
    if sys.platform != "linux":
        return
    try:
        signal.pidfd_send_signal(handle, number)
    except (ProcessLookupError, PermissionError):  # it has ended, or become another user's
        return


if __name__ == "__main__" and sys.platform == "linux":
    for ignored in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(ignored, signal.SIG_IGN)
    guard(sys.argv[1])
