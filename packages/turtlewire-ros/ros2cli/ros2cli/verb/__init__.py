"""The base of verbs, for example ``list`` of ``ros2 topic``."""

from __future__ import annotations

import argparse
import sys
from typing import Any

from ros2cli.plugin_system import (
    PLUGIN_SYSTEM_VERSION,
    instantiate_extensions,
    named_extensions,
    satisfies_version,
)

__all__ = [
    "PLUGIN_SYSTEM_VERSION",
    "VerbExtension",
    "get_verb_extensions",
    "instantiate_extensions",
    "satisfies_version",
]


class VerbExtension:
    """Base of all verbs; the first line of a verb's documentation is its line in the help.

    A verb has its own `add_arguments` and `main`, or is defined with the name of a ``module`` that
    has ``ARGUMENTS`` and ``main``.
    """

    NAME: str | None = None
    EXTENSION_POINT_VERSION = "0.1"
    _module = ""

    def __init_subclass__(cls, module: str = "", **kwargs: Any) -> None:
        super().__init_subclass__(**kwargs)
        cls._module = module or cls._module

    def __init__(self) -> None:
        satisfies_version(PLUGIN_SYSTEM_VERSION, f"^{self.EXTENSION_POINT_VERSION}")

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """Define the command line.

        Args:
            parser: Parser of the verb.
            cli_name: The words before, for example ``ros2 topic``.
        """
        from ros2cli import arguments

        module = sys.modules.get(self._module)
        arguments.add_arguments(parser, getattr(module, "ARGUMENTS", ()))

    def main(self, *, args: Any) -> Any:
        """Run the verb.

        Returns:
            The exit status, the text of an error, or None.
        """
        if not self._module:
            raise NotImplementedError
        return sys.modules[self._module].main(args)


def get_verb_extensions(name: str) -> dict[str, Any]:
    """Return the instances of the verbs of a group by name."""
    return named_extensions(name)
