"""This distribution's commands and verbs behind ROS 2's classes.

A verb is a module in :mod:`ros2cli.commands` with ``ARGUMENTS`` and ``main``. Classes such as
``ros2topic.verb.list.ListVerb`` name the module and inherit from here what calls it.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any, ClassVar

if TYPE_CHECKING:
    import argparse

__all__ = ["BuiltinCommand", "BuiltinVerb"]


class BuiltinVerb:
    """A verb whose work a module of :mod:`ros2cli.commands` does."""

    #: The module below ``ros2cli.commands``.
    _module: ClassVar[str]

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:  # noqa: ARG002
        """Define the command line of the verb."""
        from ros2cli.arguments import add_arguments

        module = import_module(f"ros2cli.commands.{self._module}")
        add_arguments(parser, getattr(module, "ARGUMENTS", ()))

    def main(self, *, args: Any) -> Any:
        """Run the verb; returns the exit status, the text of an error, or None."""
        return import_module(f"ros2cli.commands.{self._module}").main(args)


class BuiltinCommand:
    """A command whose work modules of :mod:`ros2cli.commands` do."""

    #: The module below ``ros2cli.commands``.
    _module: ClassVar[str]

    def add_arguments(
        self, parser: argparse.ArgumentParser, cli_name: str, *, argv: list[str] | None = None
    ) -> None:
        """Define the command line, with that of the verb in ``argv``."""
        from ros2cli.main import define

        define(parser, cli_name, argv or [], f"ros2cli.commands.{self._module}")

    def main(self, *, parser: argparse.ArgumentParser, args: Any) -> Any:  # noqa: ARG002
        """Run the command; prints the help and returns 0 if a verb is missing."""
        module = getattr(args, "module", None)
        if module is None:
            args.show_help()
            return 0
        return module.main(args)
