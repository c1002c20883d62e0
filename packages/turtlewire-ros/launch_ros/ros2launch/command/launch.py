"""``ros2 launch``."""

from __future__ import annotations

import argparse
import contextlib
import os
import re
import sys
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any

from ros2cli.arguments import argument, exclusive
from ros2cli.command import ModuleCommand
from ros2cli.completion import files, packages

if TYPE_CHECKING:
    from launch import LaunchContext, LaunchDescription, LaunchDescriptionSource

__all__ = [
    "ARGUMENTS",
    "LAUNCH_OPTIONS",
    "OPTION_GROUP",
    "PASSES_COLOURS_ON",
    "SUFFIXES",
    "LaunchCommand",
    "SuppressCompleterWorkaround",  # noqa: F822 - `__getattr__` hands it on
    "description_of",
    "launch",
    "launch_files",
    "main",
    "named",
    "package_name_or_launch_file_completer",
    "parsed_arguments",
    "print_description",
    "show_arguments",
]


def __getattr__(name: str) -> Any:
    """Load `SuppressCompleterWorkaround` on first use, since it needs argcomplete."""
    if name != "SuppressCompleterWorkaround":
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from ros2launch.suppress_completer import SuppressCompleterWorkaround

    return SuppressCompleterWorkaround


PASSES_COLOURS_ON = True
SUFFIXES = ("launch.py", "launch.xml", "launch.yaml", "launch.yml")


def _at_terminal() -> bool:
    return sys.stdin is not None and sys.stdin.isatty()  # None if it was closed at the start


def _files_in(share: str) -> list[str]:
    return sorted(
        file for _, _, files in os.walk(share) for file in files if file.endswith(SUFFIXES)
    )


def launch_files(*, parsed_args: argparse.Namespace, **_: Any) -> list[str]:
    """Return the names of the launch files of the package on the command line."""
    from turtlewire_ros.prefix import share_directory

    share = share_directory(parsed_args.package_name)
    return [] if share is None else _files_in(share)


def package_name_or_launch_file_completer(
    prefix: str, parsed_args: argparse.Namespace, **_: Any
) -> list[str]:
    """Return the packages, and the files that begin with a prefix."""
    del parsed_args
    return packages() + files(prefix)


ARGUMENTS = (
    argument(
        "-n",
        "--noninteractive",
        action="store_true",
        default=not _at_terminal(),
        help="Run without a terminal",
    ),
    argument("-d", "--debug", action="store_true", help="Log what the launch does in detail"),
    argument(
        "-f",
        "--log-file-name",
        default="launch",
        help="Name of the log file, to which .log is added (default: launch)",
    ),
    exclusive(
        argument(
            "-p",
            "--print",
            "--print-description",
            action="store_true",
            help="Print what would be launched, then exit",
        ),
        argument(
            "-s",
            "--show-args",
            "--show-arguments",
            action="store_true",
            help="Print the arguments of the file, then exit",
        ),
    ),
    argument(
        "-a",
        "--show-all-subprocesses-output",
        action="store_true",
        help="Show all output of all processes",
    ),
    argument("--launch-prefix", help="Command to put before all processes, for example a debugger"),
    argument(
        "--launch-prefix-filter",
        help="Pattern of the executables that get the prefix (default: all)",
    ),
    argument(
        "package_name",
        help="Name of the package, or path of a launch file",
        completer=package_name_or_launch_file_completer,
    ),
    argument("launch_file_name", nargs="?", help="Name of the launch file", completer=launch_files),
    argument("launch_arguments", nargs="*", help="Arguments of the launch file, as name:=value"),
)


#: Options that change what is launched.
LAUNCH_OPTIONS = ("show_all_subprocesses_output", "launch_prefix", "launch_prefix_filter")
#: Group of the entry points of options that other packages add.
OPTION_GROUP = "ros2launch.option"


def main(args: argparse.Namespace) -> int | str | None:
    """Launch."""
    path, args.launch_arguments = _file_and_arguments(args)
    parsed_arguments(args.launch_arguments)  # wrong ones end the command before anything starts
    if args.show_args or args.print:
        return (show_arguments if args.show_args else print_description)(description_of(path))
    extensions = getattr(args, "option_extensions", {})
    return launch(path, args, args, extensions)


def launch(path: str, options: argparse.Namespace, args: Any, extensions: Mapping[str, Any]) -> int:
    """Run a launch file to its end; returns the exit status.

    Args:
        path: Path of the file.
        options: The options of ``ros2 launch``.
        args: The command line, for the extensions.
        extensions: Options of other packages by name.
    """
    for extension in extensions.values():
        extension.prestart(args)
    description = _description_to_launch(path, options)
    for extension in extensions.values():
        changed = extension.prelaunch(description, args)
        description = description if changed is None else changed[0]
    with _terminal_restored():
        status = _launch(description, options)
    for extension in extensions.values():
        extension.postlaunch(status, args)
    return status


def _description_to_launch(path: str, options: argparse.Namespace) -> LaunchDescription:
    if options.show_all_subprocesses_output:
        # ROS 2's variable; processes read it when they are made, whatever `output` the file gives.
        os.environ["OVERRIDE_LAUNCH_PROCESS_OUTPUT"] = "both"
    arguments = given = parsed_arguments(options.launch_arguments)
    for name in ("launch_prefix", "launch_prefix_filter"):
        value = getattr(options, name)
        if value is not None:
            # Launch configurations, as in ROS 2: each process reads them when it starts.
            arguments = [*arguments, (name.replace("_", "-"), value)]
    from launch import LaunchDescription
    from launch.actions import IncludeLaunchDescription, OpaqueFunction
    from launch.launch_description_sources import AnyLaunchDescriptionSource

    source = AnyLaunchDescriptionSource(path)
    # As an action and not here: the source then reads the file within the launch, and only once.
    check = OpaqueFunction(function=_warn_of_unknown, args=[source, [name for name, _ in given]])
    return LaunchDescription([check, IncludeLaunchDescription(source, launch_arguments=arguments)])


def _warn_of_unknown(
    context: LaunchContext, source: LaunchDescriptionSource, names: list[str]
) -> None:
    """Warn of arguments whose names resemble the declared ones."""
    if not names:
        return
    from launch.logging import get_logger
    from ros2cli.suggestion import did_you_mean

    declared = [
        argument.name for argument in source.get_launch_description(context).get_launch_arguments()
    ]
    for name in names:
        meant = "" if name in declared else did_you_mean(name, declared)
        if meant:
            get_logger("launch").warning(f"the launch file declares no argument '{name}'{meant}")


def _launch(description: LaunchDescription, args: argparse.Namespace) -> int:
    from launch import LaunchService

    service = LaunchService(
        argv=args.launch_arguments,
        noninteractive=args.noninteractive,
        debug=args.debug,
        log_file_name=f"{args.log_file_name}.log",
    )
    service.include_launch_description(description)
    return service.run()


@contextlib.contextmanager
def _terminal_restored() -> Iterator[None]:
    """Restore the mode of the terminal, for a node that changed it and was killed."""
    if sys.platform == "win32" or not _at_terminal():
        yield
        return
    import termios

    mode = termios.tcgetattr(sys.stdin)
    try:
        yield
    finally:
        with contextlib.suppress(OSError, termios.error):  # the terminal is gone
            # In the background the terminal is the shell's, and setting it would stop this process.
            if os.tcgetpgrp(sys.stdin.fileno()) == os.getpgrp():
                termios.tcsetattr(sys.stdin, termios.TCSADRAIN, mode)


def _file_and_arguments(args: argparse.Namespace) -> tuple[str, list[str]]:
    """Return the path of the launch file, and the words that are arguments for it.

    Raises:
        RuntimeError: The package or file does not exist.
    """
    name: str | None = args.launch_file_name
    if os.path.isfile(args.package_name):
        return args.package_name, ([] if name is None else [name]) + args.launch_arguments
    if name is None:
        if _looks_like_a_path(args.package_name):
            raise RuntimeError(_no_file(args.package_name))
        args.parser.error(
            "the following arguments are required: launch_file_name, launch_arguments"
            + _files_of(args.package_name)
        )
    from ament_index_python.packages import PackageNotFoundError, get_package_share_directory

    try:
        share = get_package_share_directory(args.package_name)
    except PackageNotFoundError as error:
        from ros2cli.suggestion import package_meant

        raise RuntimeError(
            f"Package '{args.package_name}' not found: {error}{package_meant(args.package_name)}"
        ) from error
    return _in_share(args.package_name, share, str(name)), args.launch_arguments


def _looks_like_a_path(word: str) -> bool:
    return os.path.isdir(word) or os.sep in word or word.endswith(SUFFIXES)


def _no_file(path: str) -> str:
    """Return the error for a missing launch file, with the files in the same folder."""
    if os.path.isdir(path):
        return f"'{path}' is a folder{_list(_files_in(path))}"
    from ros2cli.suggestion import did_you_mean

    folder, name = os.path.split(path)
    known = os.listdir(folder or ".") if os.path.isdir(folder or ".") else []
    return f"No launch file at '{path}'{did_you_mean(name, known)}"


def _files_of(package: str) -> str:
    """Return a line with the launch files of a package, or with the package that was meant."""
    from ros2cli.suggestion import package_meant
    from turtlewire_ros.prefix import share_directory

    share = share_directory(package)
    if share is None:
        return f"\nPackage '{package}' not found{package_meant(package)}"
    return _list(_files_in(share))


def _list(files: list[str]) -> str:
    return f"\nLaunch files there: {', '.join(files) or 'none'}"


def named(share: str, name: str) -> list[str]:
    """Return the paths of the files of a name below a folder."""
    return [os.path.join(folder, name) for folder, _, files in os.walk(share) if name in files]


def _in_share(package: str, share: str, name: str) -> str:
    found = named(share, name)
    if not found:
        from ros2cli.suggestion import did_you_mean
        from turtlewire_ros.workspace_hints import file_hint

        message = (
            f"file '{name}' was not found in the share directory of package '{package}' "
            f"which is at '{share}'"
        )
        hint = file_hint(package, name)
        raise RuntimeError(
            f"{message}\n{hint}" if hint else message + did_you_mean(name, _files_in(share))
        )
    if len(found) > 1:
        raise RuntimeError(
            f"file '{name}' was found more than once in the share directory of package "
            f"'{package}': {sorted(found)}"
        )
    return found[0]


def parsed_arguments(words: list[str]) -> list[tuple[str, str]]:
    """``name:=value`` pairs, the last one of each name.

    Raises:
        RuntimeError: A word is not a pair.
    """
    from launch.utilities.command_line import parse_arguments

    try:
        return parse_arguments(words)
    except RuntimeError as error:
        # Forgetting the colon is the usual mistake.
        wrong = [match for word in words if (match := re.fullmatch(r"(\w+)=(.+)", word))]
        vars(error)["hint"] = f"Did you mean: {wrong[0][1]}:={wrong[0][2]}" if wrong else ""
        raise


def description_of(path: str) -> LaunchDescription:
    """Return the description in a launch file; errors get a hint with the place in the file."""
    from launch import LaunchContext
    from launch.launch_description_sources import AnyLaunchDescriptionSource
    from launch.utilities.raised_in import raised_in

    try:
        return AnyLaunchDescriptionSource(path).get_launch_description(LaunchContext())
    except Exception as error:
        if where := raised_in(error).lstrip("\n"):
            vars(error)["hint"] = where
        raise


def show_arguments(description: LaunchDescription) -> int:
    """Print the arguments that a description declares; returns 0."""
    from launch.utilities.command_line import describe_arguments

    print(describe_arguments(description.get_launch_arguments()))
    return 0


def print_description(description: LaunchDescription) -> int:
    """Print a description as a tree; returns 0."""
    from launch import LaunchIntrospector

    print(LaunchIntrospector().format_launch_description(description))
    return 0


class LaunchCommand(ModuleCommand, module=__name__):
    """Run a launch file."""
