"""Extensions: their versions, instances of all in a group, and how the command line runs them."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, Any

from ros2cli.entry_points import declared, load_entry_points
from turtlewire.plugins import PluginException, get_upper_bound_caret_version, satisfies_version

if TYPE_CHECKING:
    from turtlewire.plugins import Entry

__all__ = [
    "PLUGIN_SYSTEM_VERSION",
    "PluginException",
    "call_add_arguments",
    "define_extension",
    "define_options",
    "extensions_of_others",
    "get_upper_bound_caret_version",
    "instantiate_extensions",
    "named_extensions",
    "order_extensions",
    "order_extensions_by_name",
    "satisfies_version",
]

PLUGIN_SYSTEM_VERSION = "0.1"

_instances: dict[tuple[str, str], Any] = {}


def instantiate_extensions(
    group_name: str,
    *,
    exclude_names: Iterable[str] | None = None,
    unique_instance: bool = False,
) -> dict[str, Any]:
    """Instantiate the extensions of a group, by name; print a failure as one line on stderr.

    Args:
        group_name: Name of the group, for example ``ros2topic.verb``.
        exclude_names: Extensions to leave out.
        unique_instance: Whether to make new instances; by default there is one for each process.
    """
    found = {}
    for name, cls in load_entry_points(group_name, exclude_names=exclude_names).items():
        if not unique_instance and (group_name, name) in _instances:
            found[name] = _instances[group_name, name]
            continue
        try:
            found[name] = cls()
        # Constructors of other packages may raise any error; the other extensions still work.
        except Exception as error:  # noqa: BLE001
            from ros2cli.output import tell

            tell(f"Failed to instantiate '{group_name}' extension '{name}': {error}")
            continue
        if not unique_instance:
            _instances[group_name, name] = found[name]
    return found


def named_extensions(group_name: str, exclude_names: Iterable[str] | None = None) -> dict[str, Any]:
    """Return the extensions of `instantiate_extensions`, with the ``NAME`` of each set."""
    extensions = instantiate_extensions(group_name, exclude_names=exclude_names)
    for name, extension in extensions.items():
        extension.NAME = name
    return extensions


def order_extensions(
    extensions: dict[str, Any], key_function: Callable[[str, Any], Any], *, reverse: bool = False
) -> dict[str, Any]:
    """Return the extensions sorted by a function of name and instance."""
    ordered = sorted(extensions.items(), key=lambda item: key_function(*item), reverse=reverse)
    return dict(ordered)


def order_extensions_by_name(extensions: dict[str, Any]) -> dict[str, Any]:
    """Return the extensions sorted by name."""
    return order_extensions(extensions, lambda name, _: name)


def call_add_arguments(
    extension: Any, parser: argparse.ArgumentParser, cli_name: str, argv: list[str]
) -> None:
    """Call ``add_arguments`` of a command or a verb; verbs' do not take ``argv``."""
    import inspect

    takes_argv = "argv" in inspect.signature(extension.add_arguments).parameters
    extension.add_arguments(parser, cli_name, **({"argv": argv} if takes_argv else {}))


class _Runner:
    """Stands for the module of a verb: `main` runs the extension."""

    #: As in ROS 2, extensions are responsible for their own output.
    PASSES_COLOURS_ON = True

    def __init__(self, extension: Any, parser: argparse.ArgumentParser) -> None:
        self._extension = extension
        self._parser = parser

    def main(self, args: argparse.Namespace) -> Any:
        """Run the extension; a command gets its parser, a verb does not."""
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
    names = {name for name, entry in entries.items() if not entry.is_own}
    left_out = set(entries) - (names if chosen is None else names & {chosen})
    found = named_extensions(group, left_out)
    return found if chosen is None else {**dict.fromkeys(names - {chosen}), **found}


def define_extension(
    extension: Any, parser: argparse.ArgumentParser, prog: str, words: list[str]
) -> None:
    """Define the command line of an extension."""
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
    extensions = named_extensions(group)
    for extension in extensions.values():
        call_add_arguments(extension, parser, prog, words)
    parser.set_defaults(option_extensions=extensions)
