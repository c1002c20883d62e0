"""``ros2 run``."""

from __future__ import annotations

import argparse
import contextlib
import os
import shlex
import signal
import subprocess
import sys
import threading
from argparse import REMAINDER
from collections.abc import Iterator

from ros2cli.arguments import argument
from ros2cli.command import ModuleCommand
from ros2cli.completion import arguments_of_executable, executables, packages
from ros2cli.helpers import OPTIONAL, interactive_select
from turtlewire.distro import KILTED, since
from turtlewire_ros.process_family import ProcessFamily

__all__ = ["ARGUMENTS", "REMAINDER", "RunCommand", "main", "named", "run", "run_and_tell"]

#: Windows has no SIGHUP.
_PASSED_ON = {
    getattr(signal, name) for name in ("SIGINT", "SIGTERM", "SIGHUP") if hasattr(signal, name)
}

ARGUMENTS = (
    argument(
        "--prefix",
        help="Command to put before the executable, for example a debugger: "
        "--prefix 'gdb -ex run --args'",
    ),
    argument("package_name", nargs=OPTIONAL, help="Name of the package", completer=packages),
    argument(
        "executable_name", nargs=OPTIONAL, help="Name of the executable", completer=executables
    ),
    argument(
        "argv",
        nargs=REMAINDER,
        help="Arguments for the executable",
        completer=arguments_of_executable,
    ),
)


def main(args: argparse.Namespace) -> int | str:
    """Run the executable, and end as it ends."""
    from turtlewire_ros.executables import argv_for, executable_paths

    package = args.package_name or interactive_select(packages(), "Select package:")
    if package is None:
        return "No package selected"
    paths = executable_paths(package)
    if paths is None:
        from ros2cli.suggestion import package_meant

        raise RuntimeError(f"Package '{package}' not found{package_meant(package)}")
    executable = args.executable_name
    if executable is None:
        executable = interactive_select(map(os.path.basename, paths), "Select executable:")
        if executable is None:
            return "No executable selected"
    found = named(paths, executable)
    if not found:
        from turtlewire_ros.workspace_hints import executable_hint

        hint = executable_hint(package, executable)
        return f"No executable found\n{hint}".rstrip()
    if len(found) > 1:
        return "Multiple executables found:" + "".join(f"\n- {path}" for path in found)
    prefix = [] if args.prefix is None else shlex.split(args.prefix)
    return run_and_tell([*prefix, *argv_for(found[0]), *args.argv])


def named(paths: list[str], executable: str) -> list[str]:
    """Return the paths whose file name is the executable's."""
    names = (executable, f"{executable}.exe")
    return [path for path in paths if os.path.basename(path) in names]


def run_and_tell(command: list[str]) -> int:
    """Run a command to its end, and print it if the end is a failure; returns the status."""
    status = run(command)
    if status == 0:
        return 0
    end = signal.strsignal(-status) if status < 0 else f"Process exited with failure {status}"
    try:
        print(f"[ros2run]: {end}", flush=True)
    except SystemExit as unwritten:  # as the program's own output was, which has reported it
        raise SystemExit(status if status > 0 else unwritten.code) from None
    return status


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


class RunCommand(ModuleCommand, module=__name__):
    """Run an executable of a package."""
