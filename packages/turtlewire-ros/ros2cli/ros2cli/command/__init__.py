"""The base of the commands of ``ros2``, and the lookup of their verbs."""

from __future__ import annotations

import argparse
from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING, Any

from ros2cli.entry_points import get_entry_points, get_first_line_doc
from ros2cli.plugin_system import (
    PLUGIN_SYSTEM_VERSION,
    call_add_arguments,
    instantiate_extensions,
    named_extensions,
    satisfies_version,
)

if TYPE_CHECKING:
    from typing_extensions import Self

__all__ = [
    "PLUGIN_SYSTEM_VERSION",
    "CommandExtension",
    "ModuleCommand",
    "MutableString",
    "SuppressUsageOutput",
    "add_subparsers",
    "add_subparsers_on_demand",
    "get_command_extensions",
    "get_entry_points",
    "get_first_line_doc",
    "instantiate_extensions",
    "satisfies_version",
]


class MutableString:
    """Text that may change after it was handed over, such as the description of a parser.

    It has the methods of its text.

    Attributes:
        value: The text.
    """

    def __init__(self) -> None:
        self.value = ""

    def __getattr__(self, name: str) -> Any:
        return getattr(self.value, name)

    def __iter__(self) -> Iterator[str]:
        return iter(self.value)

    def __str__(self) -> str:
        return self.value


class SuppressUsageOutput:
    """Lets parsers of argparse neither print nor end the process within a ``with`` block.

    A wrong command line, or ``--help``, can so be looked at with ``parse_known_args``.

    Args:
        parsers: The parsers.
    """

    _METHODS = ("exit", "print_help", "print_usage")

    def __init__(self, parsers: Iterable[argparse.ArgumentParser]) -> None:
        self._parsers = list(parsers)
        self._own: list[dict[str, Any]] = []

    def __enter__(self) -> Self:
        for parser in self._parsers:
            attributes: dict[str, Any] = vars(parser)
            own = {name: attributes[name] for name in self._METHODS if name in attributes}
            self._own.append(own)
            attributes.update(dict.fromkeys(self._METHODS, _ignore))
        return self

    def __exit__(self, *args: object) -> None:
        for parser, own in zip(self._parsers, self._own, strict=True):
            for name in self._METHODS:
                del vars(parser)[name]
            vars(parser).update(own)
        self._own = []


def _ignore(*_args: Any, **_options: Any) -> None:
    """Do nothing."""


class CommandExtension:
    """The extension point for 'command' extensions.

    It is the base of the commands of ``ros2``; the first line of a command's documentation is its
    line in ``ros2 --help``.
    """

    NAME: str | None = None
    EXTENSION_POINT_VERSION = "0.1"

    def __init__(self) -> None:
        satisfies_version(PLUGIN_SYSTEM_VERSION, f"^{self.EXTENSION_POINT_VERSION}")

    def add_arguments(
        self, parser: argparse.ArgumentParser, cli_name: str, *, argv: list[str] | None = None
    ) -> None:
        """Define the command line.

        Args:
            parser: Parser of the command.
            cli_name: The words before, for example ``ros2 topic``.
            argv: The words of the command line.
        """

    def main(self, *, parser: argparse.ArgumentParser, args: Any) -> Any:
        """Run the command.

        Returns:
            The exit status, the text of an error, or None.
        """
        raise NotImplementedError


class ModuleCommand(CommandExtension):
    """Base of commands whose ``module`` has a ``VERB_GROUP``, or ``ARGUMENTS`` and ``main``."""

    _module = ""

    def __init_subclass__(cls, module: str = "", **kwargs: Any) -> None:
        super().__init_subclass__(**kwargs)
        cls._module = module or cls._module

    def add_arguments(
        self, parser: argparse.ArgumentParser, cli_name: str, *, argv: list[str] | None = None
    ) -> None:
        """Define the command line, with that of the verb in ``argv``."""
        from ros2cli.main import define

        define(parser, cli_name, argv or [], self._module)

    def main(self, *, parser: argparse.ArgumentParser, args: Any) -> Any:
        """Run the command; prints the help and returns 0 if a verb is missing."""
        del parser
        module = getattr(args, "module", None)
        if module is None:
            args.show_help()
            return 0
        return module.main(args)


def get_command_extensions(
    group_name: str, *, exclude_names: Iterable[str] | None = None
) -> dict[str, Any]:
    """Return the instances of the commands of a group by name."""
    return named_extensions(group_name, exclude_names)


def add_subparsers(
    parser: argparse.ArgumentParser,
    cli_name: str,
    dest: str,
    command_extensions: dict[str, Any],
    hide_extensions: Iterable[str] | None = None,
    required: bool = True,
) -> argparse._SubParsersAction[argparse.ArgumentParser]:
    """Add a parser for each of the extensions, which are all loaded.

    Args:
        parser: Parser of the command.
        cli_name: The words before, for example ``ros2 topic``.
        dest: Attribute of the parsed arguments that becomes the chosen extension.
        command_extensions: Extensions by name.
        hide_extensions: Names that the help leaves out.
        required: Whether one has to be chosen.
    """
    group = _group(parser, cli_name, required=required)
    for name, extension in command_extensions.items():
        extension.NAME = name
        sub = _add_parser(group, cli_name, name, extension, hide_extensions)
        sub.set_defaults(**{dest: extension})
        call_add_arguments(extension, sub, f"{cli_name} {name}", [])
    return group


def add_subparsers_on_demand(
    parser: argparse.ArgumentParser,
    cli_name: str,
    dest: str,
    group_name: str,
    hide_extensions: Iterable[str] | None = None,
    required: bool = True,
    argv: list[str] | None = None,
) -> argparse._SubParsersAction[argparse.ArgumentParser]:
    """Add a parser for each extension of a group; loads only the one on the command line.

    Args:
        parser: Parser of the command.
        cli_name: The words before, for example ``ros2 topic``.
        dest: Attribute of the parsed arguments that becomes the chosen extension.
        group_name: The group, for example ``ros2topic.verb``.
        hide_extensions: Names that the help leaves out.
        required: Whether one has to be chosen.
        argv: The words after ``cli_name``; this process's by default.
    """
    group = _group(parser, cli_name, required=required)
    words = _words_after(cli_name) if argv is None else argv
    entries = get_entry_points(group_name)
    chosen = next((word for word in words if not word.startswith("-")), None)
    # Without a chosen one, the help needs all classes for their summaries.
    load = {chosen} if chosen in entries else set(entries)
    loaded = get_command_extensions(group_name, exclude_names=set(entries) - load)
    for name in sorted(entries):
        extension = loaded.get(name)
        if extension is None and name in load:
            continue  # its error has already been printed
        sub = _add_parser(group, cli_name, name, extension, hide_extensions)
        if extension is not None:
            sub.set_defaults(**{dest: extension})
        if name == chosen and extension is not None:
            rest = words[words.index(name) + 1 :]
            call_add_arguments(extension, sub, f"{cli_name} {name}", rest)
    return group


def _group(
    parser: argparse.ArgumentParser, cli_name: str, *, required: bool
) -> argparse._SubParsersAction[argparse.ArgumentParser]:
    hint = f"Call `{cli_name} <command> -h` for more detailed usage."
    group = parser.add_subparsers(title="Commands", description="", metavar=hint)
    group.required = required
    return group


def _words_after(cli_name: str) -> list[str]:
    """Return the words of this process after the last one of ``cli_name``."""
    import sys

    command = cli_name.rpartition(" ")[2]
    words = sys.argv[1:]
    return words[words.index(command) + 1 :] if command in words else words


def _add_parser(
    group: argparse._SubParsersAction[argparse.ArgumentParser],
    cli_name: str,
    name: str,
    extension: Any,
    hidden: Iterable[str] | None,
) -> argparse.ArgumentParser:
    summary = get_first_line_doc(extension) if extension is not None else ""
    prog = f"{cli_name} {name}"
    # Without `help`, argparse leaves a parser out of its list.
    if name in (hidden or ()):
        return group.add_parser(name, description=summary, prog=prog)
    return group.add_parser(name, help=summary, description=summary, prog=prog)
