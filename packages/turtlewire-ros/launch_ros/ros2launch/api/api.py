"""Launch files: found, shown and run."""

from __future__ import annotations

import argparse
import os
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from ros2launch.command import launch as command

if TYPE_CHECKING:
    from launch import LaunchDescription
    from ros2launch.option import OptionExtension


class MultipleLaunchFilesError(Exception):
    """A package has several files of one name.

    Args:
        msg: The text.
        paths: Their paths.
    """

    def __init__(self, msg: str, paths: Sequence[str]) -> None:
        super().__init__(msg)
        self.msg = msg
        self.paths = paths


def get_share_file_path_from_package(*, package_name: str, file_name: str) -> str:
    """Return the path of a file below the share folder of a package.

    Raises:
        PackageNotFoundError: The package does not exist.
        FileNotFoundError: The package has no such file.
        MultipleLaunchFilesError: The package has several such files.
    """
    from ament_index_python.packages import get_package_share_directory

    share = get_package_share_directory(package_name)
    found = command.named(share, file_name)
    where = f"in the share directory of package '{package_name}' which is at '{share}'"
    if not found:
        raise FileNotFoundError(f"file '{file_name}' was not found {where}")
    if len(found) > 1:
        raise MultipleLaunchFilesError(
            f"file '{file_name}' was found more than once {where}", found
        )
    return found[0]


def get_launch_file_paths(*, path: str) -> list[str]:
    """Return the paths of all launch files below a folder."""
    return [
        os.path.join(folder, name)
        for folder, _, names in os.walk(path)
        for name in sorted(names)
        if is_launch_file(name)
    ]


def is_launch_file(path: str) -> bool:
    """Return True if the name is one of a launch file: in Python, XML or YAML."""
    return path.endswith(command.SUFFIXES)


def parse_launch_arguments(launch_arguments: Sequence[str]) -> list[tuple[str, str]]:
    """Return the ``name:=value`` pairs, the last one of each name.

    Raises:
        RuntimeError: A word is not a pair.
    """
    return command.parsed_arguments(list(launch_arguments))


def print_a_launch_file(*, launch_file_path: str) -> None:
    """Print what a launch file describes, as a tree.

    Raises:
        InvalidLaunchFileError: No loader can read it.
    """
    command.print_description(command.description_of(launch_file_path))


def print_arguments_of_launch_file(*, launch_file_path: str) -> None:
    """Print the arguments that a launch file declares.

    Raises:
        InvalidLaunchFileError: No loader can read it.
    """
    description = command.description_of(launch_file_path)
    print_arguments_of_launch_description(launch_description=description)


def print_arguments_of_launch_description(*, launch_description: LaunchDescription) -> None:
    """Print the arguments that a description declares."""
    command.show_arguments(launch_description)


def launch_a_launch_file(
    *,
    launch_file_path: str,
    launch_file_arguments: Sequence[str],
    noninteractive: bool = False,
    args: Any = None,
    option_extensions: Mapping[str, OptionExtension] = {},
    debug: bool = False,
) -> int:
    """Run a launch file to its end; returns the exit status.

    Args:
        launch_file_path: Its path.
        launch_file_arguments: Its arguments, as ``name:=value``.
        noninteractive: Whether there is no terminal.
        args: The command line, for the extensions; options of ``ros2 launch`` in it count.
        option_extensions: Options of other packages by name.
        debug: Whether to log what the launch does in detail.

    Raises:
        RuntimeError: An argument is not of the form ``name:=value``.
    """
    options = argparse.Namespace(
        launch_arguments=list(launch_file_arguments),
        noninteractive=noninteractive,
        debug=debug,
        log_file_name=getattr(args, "log_file_name", "launch"),
        **{name: getattr(args, name, None) for name in command.LAUNCH_OPTIONS},
    )
    return command.launch(launch_file_path, options, args, option_extensions)


class LaunchFileNameCompleter:
    """Offers the launch files of the package on the command line to the shell.

    Args:
        package_name_key: Attribute of the command line that is the package.
    """

    def __init__(self, *, package_name_key: str | None = None) -> None:
        self.package_name_key = package_name_key or "package_name"

    def __call__(self, prefix: str, parsed_args: argparse.Namespace, **kwargs: Any) -> list[str]:
        """Return the names of the launch files."""
        package = getattr(parsed_args, self.package_name_key)
        return command.launch_files(parsed_args=argparse.Namespace(package_name=package))
