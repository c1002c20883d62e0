"""Executables of packages: found and run."""

from __future__ import annotations

import argparse
import shlex
from collections.abc import Sequence
from typing import Any

from ros2cli import completion
from ros2pkg.api import get_executable_paths
from ros2run.command.run import named, run_and_tell

ROS2RUN_MSG_PREFIX = "[ros2run]:"


class MultipleExecutables(Exception):
    """A package has several executables of one name.

    Args:
        paths: Their paths.
    """

    def __init__(self, paths: Sequence[str]) -> None:
        super().__init__(paths)
        self.paths = paths


def get_executable_path(*, package_name: str, executable_name: str) -> str | None:
    """Return the path of an executable; None if the package has none of that name.

    Raises:
        PackageNotFound: There is no such package.
        MultipleExecutables: It has several of that name.
    """
    found = named(get_executable_paths(package_name=package_name), executable_name)
    if len(found) > 1:
        raise MultipleExecutables(found)
    return found[0] if found else None


def run_executable(*, path: str, argv: Sequence[str], prefix: str | None = None) -> int:
    """Run an executable in the foreground, and print how it ends if that is a failure.

    Args:
        path: Its path.
        argv: Its arguments.
        prefix: Words to put before it, for example ``gdb --args``.

    Returns:
        The exit status, negative for a signal.
    """
    from turtlewire_ros.executables import argv_for

    return run_and_tell([*shlex.split(prefix or ""), *argv_for(path), *argv])


class ExecutableNameCompleter:
    """Offers the executables of the package on the command line to the shell.

    Args:
        package_name_key: Attribute of the command line that is the package.
    """

    def __init__(self, *, package_name_key: str | None = None) -> None:
        self.package_name_key = package_name_key

    def __call__(self, prefix: str, parsed_args: argparse.Namespace, **kwargs: Any) -> list[str]:
        """Return the names of the executables."""
        package = getattr(parsed_args, self.package_name_key or "", None) or ""
        return completion.executables_of(package)
