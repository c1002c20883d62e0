"""Decorators that make ROS 2's classes from modules of commands and verbs.

A verb is a module with ``ARGUMENTS`` and ``main``; a command may have a ``VERB_GROUP`` as well. The
command line calls the module. These decorators give programs and extensions ROS 2's class of it.
"""

from __future__ import annotations

import argparse
import sys
from typing import TYPE_CHECKING, Any, TypeVar

if TYPE_CHECKING:
    Class = TypeVar("Class", bound=type[Any])


def verb_of_module(cls: Class) -> Class:
    """Give a class the ``ARGUMENTS`` of its module, and the ``main`` unless it has its own."""
    module = sys.modules[cls.__module__]

    def add_arguments(self: Any, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """Define the command line of the verb."""
        from ros2cli import arguments

        arguments.add_arguments(parser, getattr(module, "ARGUMENTS", ()))

    def main(self: Any, *, args: Any) -> Any:
        """Run the verb; returns the exit status, the text of an error, or None."""
        return module.main(args)

    cls.add_arguments = add_arguments
    if "main" not in vars(cls):
        cls.main = main
    return cls


def command_of_module(cls: Class) -> Class:
    """Give a class the command line of its module, with its verbs, and what runs them."""
    name = cls.__module__

    def add_arguments(
        self: Any,
        parser: argparse.ArgumentParser,
        cli_name: str,
        *,
        argv: list[str] | None = None,
    ) -> None:
        """Define the command line, with that of the verb in ``argv``."""
        from ros2cli.main import define

        define(parser, cli_name, argv or [], name)

    def main(self: Any, *, parser: argparse.ArgumentParser, args: Any) -> Any:
        """Run the command; prints the help and returns 0 if a verb is missing."""
        module = getattr(args, "module", None)
        if module is None:
            args.show_help()
            return 0
        return module.main(args)

    cls.add_arguments = add_arguments
    cls.main = main
    return cls
