"""A script that runs a command, and ends it with every process that it started.

``python supervise.py SECONDS BYTES COMMAND…`` ends when the command ends, when the time is up, or
when its stdin ends, which happens when the program that started it ends. On Linux it also ends
processes that have left the session, because it is the parent of orphans. Elsewhere it ends the
command's process group, or on Windows its tree.
"""

from __future__ import annotations

import ctypes
import os
import signal
import subprocess
import sys
import threading

__all__ = ["TIME_IS_OVER", "supervise"]

#: Exit status when the command did not end in time, as that of ``timeout``.
TIME_IS_OVER = 124
_SET_DUMPABLE, _SET_CHILD_SUBREAPER = 4, 36  # <sys/prctl.h>
#: A process may start another group while /proc is read; each round finds fewer.
_ROUNDS = 100


def supervise(seconds: float, memory: int, command: list[str]) -> int:
    """Run a command.

    Args:
        seconds: How long it may take.
        memory: How much address space it may have [bytes]; Linux only.
        command: What to run.

    Returns:
        Its exit status (minus the signal's number if a signal ended it), or :data:`TIME_IS_OVER`.
    """
    if sys.platform == "linux":
        libc = ctypes.CDLL(None)
        libc.prctl(_SET_DUMPABLE, 0, 0, 0, 0)  # the command opens none of its files in /proc
        libc.prctl(_SET_CHILD_SUBREAPER, 1, 0, 0, 0)
        _limit(memory)
    child = subprocess.Popen(  # noqa: S603 - what the caller wants
        command, stdin=subprocess.DEVNULL, start_new_session=True
    )
    watcher = threading.Thread(target=_end_with_stdin, args=(child,), daemon=True)
    watcher.start()
    try:
        return child.wait(seconds)
    except subprocess.TimeoutExpired:
        return TIME_IS_OVER
    finally:
        _end_all(child)


def _limit(memory: int) -> None:
    if sys.platform == "linux":
        import resource

        resource.setrlimit(resource.RLIMIT_AS, (memory, memory))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def _end_with_stdin(child: subprocess.Popen[bytes]) -> None:
    while os.read(0, 4096):
        pass
    _end_all(child)
    os._exit(TIME_IS_OVER)


def _end_all(child: subprocess.Popen[bytes]) -> None:
    if sys.platform == "win32":
        tree = ["taskkill", "/F", "/T", "/PID", str(child.pid)]
        subprocess.run(tree, capture_output=True, check=False)  # noqa: S603 - Windows's own
        return
    if sys.platform != "linux":
        _send(-child.pid, signal.SIGKILL)
        return
    for _ in range(_ROUNDS):
        # Whole groups, because a process could start another one just before it is killed.
        for group in _groups_below():
            _send(-group, signal.SIGKILL)
        # A process may have begun while /proc was read, and its parent ended. Orphans become
        # children of this process: without children it has no descendants either.
        if not _reap():
            return


def _groups_below() -> set[int]:
    """Return the process groups of all descendants, including zombies' groups."""
    below: dict[int, list[tuple[int, int]]] = {}
    for name in os.listdir("/proc"):
        if not name.isdigit():
            continue
        try:
            with open(f"/proc/{name}/stat", "rb") as file:
                _, parent, pgrp = file.read().rpartition(b")")[2].split()[:3]
        except OSError:  # it has already ended
            continue
        below.setdefault(int(parent), []).append((int(name), int(pgrp)))
    groups: set[int] = set()
    waiting = [os.getpid()]
    while waiting:
        for process, group in below.get(waiting.pop(), []):
            waiting.append(process)
            groups.add(group)
    return groups


def _send(process: int, number: signal.Signals) -> None:
    try:
        os.kill(process, number)
    except (ProcessLookupError, PermissionError):  # it has ended, or become another user's
        return


def _reap() -> bool:
    """Wait until a child has ended and reap all that have; returns whether any child is left."""
    if sys.platform == "win32":
        return False
    try:
        os.waitpid(-1, 0)
        while os.waitpid(-1, os.WNOHANG)[0]:
            pass
    except ChildProcessError:
        return False
    return True


if __name__ == "__main__":
    status = supervise(float(sys.argv[1]), int(sys.argv[2]), sys.argv[3:])
    sys.exit(status if status >= 0 else 128 - status)
