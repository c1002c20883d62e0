"""Commands and verbs of other packages, as the command line runs them."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING, Any

from ros2cli.installed import declared

if TYPE_CHECKING:
    from turtlewire.plugins import Entry


class _Runner:
    """Stands for the module of a verb: `main` runs the extension."""

    #: As in ROS 2, extensions are responsible for their own output.
    PASSES_COLOURS_ON = True

    def __init__(self, extension: Any, parser: argparse.ArgumentParser) -> None:
        self._extension = extension
        self._parser = parser

    def main(self, args: argparse.Namespace) -> Any:
        """Run it; a command gets its parser, a verb does not."""
        import inspect

        if "parser" in inspect.signature(self._extension.main).parameters:
            return self._extension.main(parser=self._parser, args=args)
        return self._extension.main(args=args)


def extensions_of_others(
    group: str, entries: dict[str, Entry], chosen: str | None
) -> dict[str, Any]:
    """Return extensions by name; print one line on stderr for each that cannot be loaded.

    Args:
        group: For example ``ros2topic.verb``.
        entries: The entry points of the group.
        chosen: Name of the only one to load; the others are None. None loads all.
    """
    from ros2cli.plugin_system import named_extensions

    names = {name for name, entry in entries.items() if not entry.is_own}
    left_out = set(entries) - (names if chosen is None else names & {chosen})
    found = named_extensions(group, left_out)
    return found if chosen is None else {**dict.fromkeys(names - {chosen}), **found}


def define_extension(
    extension: Any, parser: argparse.ArgumentParser, prog: str, words: list[str]
) -> None:
    """Define the command line of an extension."""
    from ros2cli.plugin_system import call_add_arguments

    call_add_arguments(extension, parser, prog, words)
    parser.set_defaults(module=_Runner(extension, parser), parser=parser)


def define_options(
    group: str, parser: argparse.ArgumentParser, prog: str, words: list[str]
) -> None:
    """Define the options that other packages add to a command.

    Args:
        group: Group of their entry points, for example ``ros2launch.option``.
        parser: Parser of the command.
        prog: The words before.
        words: The words after ``prog``.
    """
    if not declared(group):
        return
    from ros2cli.plugin_system import call_add_arguments, named_extensions

    extensions = named_extensions(group)
    for extension in extensions.values():
        call_add_arguments(extension, parser, prog, words)
    parser.set_defaults(option_extensions=extensions)
