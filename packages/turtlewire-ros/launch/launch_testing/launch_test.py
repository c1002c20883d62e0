"""The command ``launch_test``."""

from __future__ import annotations

import argparse
import importlib.util
import os
import sys
import traceback
from types import ModuleType
from typing import Any

from launch_testing.junitxml import unittestResultsToXml
from launch_testing.loader import LoadTestsFromPythonModule
from launch_testing.print_arguments import print_arguments_of_launch_description
from launch_testing.test_runner import LaunchTestRunner
from turtlewire.new_file import new_file
from turtlewire.program import program


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of the command to a parser."""
    parser.add_argument("launch_test_file", help="Path of the launch test")
    parser.add_argument(
        "-v", "--verbose", action="store_true", help="Log what the launch does in detail"
    )
    parser.add_argument(
        "-s",
        "--show-args",
        "--show-arguments",
        action="store_true",
        help="Show the arguments of the launch test, and exit",
    )
    parser.add_argument(
        "--package-name", help="Name for the report; by default the file's name without extension"
    )
    parser.add_argument("--junit-xml", dest="xmlpath", help="Where to write a report as JUnit XML")
    parser.add_argument(
        "launch_arguments", nargs="*", help="Arguments of the launch test, as name:=value"
    )


def parse_arguments() -> tuple[argparse.ArgumentParser, argparse.Namespace]:
    """Return the parser of the command, and what it found on the command line of this process."""
    parser = argparse.ArgumentParser(
        prog="launch_test", description="Run tests against what a launch description starts."
    )
    add_arguments(parser)
    return parser, parser.parse_args()


def run(
    parser: argparse.ArgumentParser,
    args: argparse.Namespace,
    test_runner_cls: type[LaunchTestRunner] = LaunchTestRunner,
) -> int:
    """Run the tests of a file.

    Args:
        parser: Prints errors of the command line; it then ends the program with status 2.
        args: What it found.
        test_runner_cls: Runs the launches.

    Returns:
        0, or 1 if a test failed.
    """
    name = os.path.splitext(os.path.basename(args.launch_test_file))[0]
    full_name = f"{args.package_name or name}.{name}"
    module = _checked_module(parser, args, name)
    runs = LoadTestsFromPythonModule(module, name=f"{full_name}.launch_tests")
    runner = test_runner_cls(runs, args.launch_arguments, args.verbose)
    try:
        runner.validate()
        if args.show_args:
            description = runs[0].get_launch_description()
            print_arguments_of_launch_description(launch_description=description)
            return 0
        results = runner.run()
    except Exception as error:  # noqa: BLE001  the file's own code may raise anything
        traceback.print_exc()
        parser.error(str(error))
    for result in results.values():
        if message := getattr(result, "message", ""):
            print(f"FAILED: {message}")
    if args.xmlpath:
        report = unittestResultsToXml(name=full_name, test_results=results)
        try:
            with new_file(args.xmlpath) as unfinished:
                report.write(unfinished, encoding="utf-8", xml_declaration=True)
        except OSError as error:
            parser.error(f"argument --junit-xml: cannot write '{args.xmlpath}': {error.strerror}")
    return int(not all(result.wasSuccessful() for result in results.values()))


def _checked_module(
    parser: argparse.ArgumentParser, args: argparse.Namespace, name: str
) -> ModuleType:
    """Return the test file as a module, or end the program with an error of the command line."""
    file = args.launch_test_file
    try:
        os.getcwd()
    except FileNotFoundError:
        parser.error("the current folder was deleted")
    if not os.path.isfile(file):
        parser.error(f"Test file '{file}' does not exist")
    if args.xmlpath and not _can_write(args.xmlpath):  # before tests that may take minutes
        parser.error(f"argument --junit-xml: cannot write '{args.xmlpath}'")
    module = _imported(name, os.path.abspath(file))
    if module is None:
        parser.error(f"Test file '{file}' is not a Python file: .py is missing")
    if not hasattr(module, "generate_test_description"):
        parser.error(f"Test file '{file}' is missing generate_test_description function")
    return module


@program
def main() -> int:
    """Run the command line of this process; return its exit status."""
    parser, args = parse_arguments()
    return run(parser, args)


def _can_write(path: str) -> bool:
    if os.path.exists(path) and (os.path.isdir(path) or not os.access(path, os.W_OK)):
        return False
    is_device = os.path.exists(path) and not os.path.isfile(path)
    return is_device or os.access(os.path.dirname(os.path.realpath(path)), os.W_OK)


def _imported(name: str, path: str) -> ModuleType | None:
    """Return the file as a separate module; files next to it can be imported as in a script.

    None if it is not a Python file.
    """
    specification: Any = importlib.util.spec_from_file_location(name, path)
    if specification is None:
        return None
    sys.path.insert(0, os.path.dirname(path))
    module = importlib.util.module_from_spec(specification)
    sys.modules[name] = module  # dataclasses and pickle look for it there
    specification.loader.exec_module(module)
    return module


if __name__ == "__main__":
    sys.exit(main())
