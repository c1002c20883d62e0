"""``ros2 test``."""

from __future__ import annotations

import argparse
import contextlib
import os
from typing import TYPE_CHECKING

from ros2cli.arguments import argument
from ros2cli.command import ModuleCommand
from ros2cli.completion import files

if TYPE_CHECKING:
    from typing import Any

PASSES_COLOURS_ON = True


def _files(prefix: str, **_: Any) -> list[str]:
    return files(prefix)


ARGUMENTS = (
    argument("launch_test_file", help="Path of the launch test", completer=_files),
    argument("-v", "--verbose", action="store_true", help="Log what the launch does in detail"),
    argument(
        "-s",
        "--show-args",
        "--show-arguments",
        action="store_true",
        help="Show the arguments of the launch test, and exit",
    ),
    argument(
        "--package-name", help="Name for the report; by default the file's name without extension"
    ),
    argument("--junit-xml", dest="xmlpath", help="Where to write a report as JUnit XML"),
    argument(
        "--disable-isolation",
        action="store_true",
        help="Stay in the default domain instead of choosing a free one",
    ),
    argument("launch_arguments", nargs="*", help="Arguments of the launch test, as name:=value"),
)


def main(args: argparse.Namespace) -> int:
    """Run the launch test, in its own domain unless ``ROS_DOMAIN_ID`` chooses one."""
    with contextlib.ExitStack() as stack:
        # A domain chosen by the user stays as it is.
        if not args.disable_isolation and "ROS_DOMAIN_ID" not in os.environ:
            from turtlewire.testing import reserved_domain

            domain = stack.enter_context(reserved_domain())
            print(f"Running with ROS_DOMAIN_ID {domain}")
            os.environ["ROS_DOMAIN_ID"] = str(domain)
            stack.callback(os.environ.pop, "ROS_DOMAIN_ID")
        from launch_testing.launch_test import run
        from launch_testing_ros import LaunchTestRunner

        return run(args.parser, args, LaunchTestRunner)


class TestCommand(ModuleCommand, module=__name__):
    """Run a launch test in its own domain."""
