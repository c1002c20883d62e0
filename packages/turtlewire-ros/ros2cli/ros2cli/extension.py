"""Commands and verbs of other packages, as the command line runs them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ros2cli.entry_points import others

if TYPE_CHECKING:
    import argparse

__all__ = ["define_extension", "define_options", "extensions_of_others"]


class _Runner:
    """Stands for the module of a verb: `main` runs the extension."""

    #: As ROS 2 does: the extension answers for its output.
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


def extensions_of_others(prog: str, chosen: str | None) -> dict[str, Any]:
    """Extensions by name; those that cannot be loaded are one line each on stderr.

    Args:
        prog: ``ros2`` for commands, ``ros2 topic`` for verbs of that.
        chosen: Name of the only one to load; the others are None. None loads all.
    """
    command = prog.rpartition(" ")[2]
    group = {"ros2": "ros2cli.command", "daemon": "ros2cli.daemon.verb"}.get(
        command, f"ros2{command}.verb"
    )
    names = set(others(group))
    if not names:
        return {}
    from ros2cli.entry_points import get_entry_points
    from ros2cli.plugin_system import named_extensions

    left_out = set(get_entry_points(group)) - (names if chosen is None else {chosen})
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
        words: The words behind ``prog``.
    """
    if not others(group):
        return
    from ros2cli.plugin_system import call_add_arguments, named_extensions

    extensions = named_extensions(group)
    for extension in extensions.values():
        call_add_arguments(extension, parser, prog, words)
    parser.set_defaults(option_extensions=extensions)
