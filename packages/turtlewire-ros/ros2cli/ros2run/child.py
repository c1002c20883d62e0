"""Runs a program in the foreground, for ``ros2 run``: passes signals on, leaves nothing behind."""

from __future__ import annotations

import contextlib
import os
import signal
import subprocess
import sys
import threading
from collections.abc import Iterator

from turtlewire.distro import KILTED, since
from turtlewire_ros.process_family import ProcessFamily

#: Windows has no SIGHUP.
_PASSED_ON = {
    getattr(signal, name) for name in ("SIGINT", "SIGTERM", "SIGHUP") if hasattr(signal, name)
}


def run(command: list[str]) -> int:
    """Run a program to its end, and stop what it leaves behind.

    A signal to this process is passed on, except for Ctrl-C: the terminal sends that to the program
    as well.

    Returns:
        The exit status, negative for a signal.

    Raises:
        OSError: The program cannot be started.
    """
    family = ProcessFamily()
    family.start()
    try:
        return _run_in_family(command, family.marked(os.environ))
    finally:
        family.stop()


def _run_in_family(command: list[str], environment: dict[str, str]) -> int:
    if threading.current_thread() is not threading.main_thread():
        return _run(command, environment)  # only the main thread gets signals
    if sys.platform == "linux":
        return _run_and_pass_on_signals(command, environment)
    with _passed_on_by_handlers() as children:
        return _run(command, environment, children)


def _run_and_pass_on_signals(command: list[str], environment: dict[str, str]) -> int:
    if sys.platform != "linux":
        raise OSError("only Linux reports the sender of a signal")
    # Blocked, so that `sigwaitinfo` gets them together with their sender.
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGCHLD, *_PASSED_ON})
    try:
        process = subprocess.Popen(  # noqa: S603
            command,
            env=environment,
            # `ros2 run` has one thread.
            preexec_fn=lambda: signal.pthread_sigmask(signal.SIG_SETMASK, before),  # noqa: PLW1509
        )
        while (status := process.poll()) is None:
            arrived = signal.sigwaitinfo({signal.SIGCHLD, *_PASSED_ON})
            # The kernel is the sender if a key was pressed: then the program has got the signal as
            # well.
            typed = arrived.si_signo == signal.SIGINT and arrived.si_pid == 0
            if arrived.si_signo != signal.SIGCHLD and not typed:
                process.send_signal(arrived.si_signo)
            _tell(arrived.si_signo)
        return status
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def _tell(number: int) -> None:
    """Print which signal has arrived, as ROS 2 does from Kilted on."""
    if number in (signal.SIGINT, signal.SIGTERM) and since(KILTED):
        with contextlib.suppress(BrokenPipeError):  # the reader of a pipe may have ended before
            # ROS 2 has two blanks here.
            print(f"[ros2run]: Received signal:  {signal.strsignal(number)}", flush=True)


def _run(
    command: list[str],
    environment: dict[str, str],
    children: list[subprocess.Popen[bytes]] | None = None,
) -> int:
    with subprocess.Popen(command, env=environment) as process:  # noqa: S603
        if children is not None:
            children.append(process)
        while process.returncode is None:
            try:
                process.wait()
            except KeyboardInterrupt:  # noqa: PERF203  the program decides what Ctrl-C means
                _tell(signal.SIGINT)
    return process.returncode


@contextlib.contextmanager
def _passed_on_by_handlers() -> Iterator[list[subprocess.Popen[bytes]]]:
    """Pass SIGTERM and SIGHUP on to the processes that are put into the list."""
    children: list[subprocess.Popen[bytes]] = []

    def handle(number: int, _frame: object) -> None:
        for process in children:
            process.send_signal(number)
        _tell(number)

    # Not SIGINT: here, Ctrl-C, which the program has got as well, looks like a signal to this
    # process.
    before = {number: signal.signal(number, handle) for number in _PASSED_ON - {signal.SIGINT}}
    try:
        yield children
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
