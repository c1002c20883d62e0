"""``ros2 run``."""

from __future__ import annotations

import argparse
import os
import shlex
import signal
from argparse import REMAINDER

from ros2cli.arguments import argument
from ros2cli.command import ModuleCommand
from ros2cli.completion import arguments_of_executable, executables, packages
from ros2cli.helpers import interactive_select
from ros2cli.selection import OPTIONAL
from ros2run.child import run

__all__ = ["ARGUMENTS", "REMAINDER", "RunCommand", "main", "named", "run_and_tell"]


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


class RunCommand(ModuleCommand):
    """Run an executable of a package."""
