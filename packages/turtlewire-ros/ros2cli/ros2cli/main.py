# PYTHON_ARGCOMPLETE_OK
"""The ``ros2`` command."""

from __future__ import annotations

import argparse
import io
import os
import signal
import sys
from collections.abc import Container
from contextlib import nullcontext, suppress
from importlib import import_module
from types import ModuleType
from typing import TYPE_CHECKING

from ros2cli.entry_points import declared, first_line, summary
from turtlewire.program import program
from turtlewire.terminal.parser import INVALID_CHOICE, SuggestingParser

if TYPE_CHECKING:
    from typing import NoReturn

_EXIT_INTERRUPTED = 2  # the number of SIGINT

#: Commands of ROS 2 that are not here, and what does their work.
_NOT_HERE = {
    "plugin": "Plugins of C++ are not part of this distribution.",
    "security": "Keys for DDS Security are not part of this distribution; Zenoh encrypts with TLS: "
    "RMW_IMPLEMENTATION=rmw_zenoh_cpp.",
}


class _Parser(SuggestingParser):
    """A parser that names what ROS 2 has and this distribution has not."""

    def error(self, message: str) -> NoReturn:
        """Print usage and message as argparse does, and a hint."""
        match = INVALID_CHOICE.search(message)
        if match and self.prog == "ros2" and (told := _told_instead(match[1])):
            self.exit(2, f"ros2 {match[1]}: {told}\n")
        super().error(message)


def _told_instead(command: str) -> str:
    """Say where a command of ROS 2 is, or what does its work; empty for unknown commands."""
    if command != "control":
        return _NOT_HERE.get(command, "")
    from turtlewire_ros.workspace_hints import source_hint

    return source_hint("ros2controlcli")


@program
def main(argv: list[str] | None = None) -> int:
    """Run a command line.

    Args:
        argv: The words after ``ros2``; None for this process's.

    Returns:
        The exit status.
    """
    words = sys.argv[1:] if argv is None else argv
    with suppress(ValueError):  # only the main thread may set handlers
        # Verbs end at SIGTERM as at Ctrl-C: they leave the domain.
        signal.signal(signal.SIGTERM, signal.default_int_handler)
    try:
        args = _parse(words)
        if argv is None and callable(signal.getsignal(signal.SIGINT)):
            # Until here, the guard's handler has ended the process.
            signal.signal(signal.SIGINT, signal.default_int_handler)
        return _status(args)
    except KeyboardInterrupt:
        return _EXIT_INTERRUPTED
    finally:
        if argv is None:
            # The command has finished: an interrupt ends the process silently.
            signal.signal(signal.SIGINT, signal.SIG_DFL)


def _parse(words: list[str]) -> argparse.Namespace:
    parser = make_parser(_words_to_complete() or words)
    if "_ARGCOMPLETE" in os.environ:
        import argcomplete
        from argcomplete.completers import SuppressCompleter

        no_files = SuppressCompleter()  # the arguments that are files say so
        argcomplete.autocomplete(parser, exclude=["-h", "--help"], default_completer=no_files)
    args, unknown = parser.parse_known_args(words)
    # Reported by the chosen verb, so that its usage is shown instead of that of `ros2`.
    if unknown:
        chosen = getattr(args, "parser", parser)
        chosen.error(f"unrecognized arguments: {' '.join(unknown)}")
    if isinstance(sys.stdout, io.TextIOWrapper):  # it is None if it was closed at the start
        # A character that the encoding of a pipe or terminal does not have must not end a verb.
        sys.stdout.reconfigure(errors="backslashreplace")
        # As in ROS 2, a reader at a pipe gets each line at once.
        if not args.use_python_default_buffering:
            sys.stdout.reconfigure(line_buffering=True)
    return args


def make_parser(words: list[str]) -> argparse.ArgumentParser:
    """Return the parser for a command line; loads only the commands and verbs that are on it.

    Args:
        words: The words after ``ros2``.
    """
    parser = _Parser(
        prog="ros2",
        description="Run, inspect and control ROS 2 nodes.",
    )
    parser.add_argument(
        "--use-python-default-buffering",
        action="store_true",
        help="Use Python's default buffering of the output",
    )
    parser.set_defaults(show_help=parser.print_help)
    _add_choices(parser, "ros2", "ros2cli.command", words)
    return parser


def _add_choices(
    parser: argparse.ArgumentParser, prog: str, group_name: str, words: list[str]
) -> None:
    """Add commands or verbs, and load the one on the command line."""
    title = "Verbs" if " " in prog else "Commands"
    chosen = next((word for word in words if not word.startswith("-")), None)
    entries = declared(group_name, chosen)
    others: dict[str, object] = {}
    if not all(entry.is_own for entry in entries.values()):
        from ros2cli.plugin_system import extensions_of_others

        others = extensions_of_others(group_name, entries, chosen)
    # An option before the chosen word may be one for the help, and shells show the lines as well.
    is_shown = chosen not in entries or chosen != words[0] or "_ARGCOMPLETE" in os.environ
    summaries = {
        name: summary(entry) if is_shown or name == chosen else ""
        for name, entry in entries.items()
        if entry.is_own
    }
    summaries.update({name: first_line(extension) for name, extension in others.items()})
    group = parser.add_subparsers(
        title=title,
        metavar=f"Call `{prog} <command> -h` for more detailed usage.",
        parser_class=_parser_class(summaries, chosen),
    )
    for name, text in sorted(summaries.items()):
        sub = group.add_parser(
            name,
            help=text,
            description=text,
            prog=f"{prog} {name}",
        )
        if name != chosen:
            continue
        rest = words[words.index(name) + 1 :]
        if name in others:
            from ros2cli.plugin_system import define_extension

            define_extension(others[name], sub, f"{prog} {name}", rest)
        else:
            define(sub, f"{prog} {name}", rest, entries[name].module)


def _parser_class(choices: Container[str], chosen: str | None) -> type[_Parser]:
    """Return the parser class of each choice; choices that cannot be called share one."""
    if chosen is not None and chosen not in choices:
        return _Parser
    # Two dozen parsers would take a tenth of the time of `ros2 --help`.
    shared = _Parser(add_help=False)
    return lambda **options: (  # type: ignore[return-value]  # argparse only calls it
        _Parser(**options) if options["prog"].rpartition(" ")[2] == chosen else shared
    )


def define(parser: argparse.ArgumentParser, prog: str, words: list[str], module_name: str) -> None:
    """Define the command line of a command or a verb, and of the verb in ``words``.

    Args:
        parser: Its parser.
        prog: The words before, for example ``ros2 topic``.
        words: The words after ``prog``.
        module_name: Its module, for example ``ros2topic.command.topic``.
    """
    from ros2cli.arguments import add_arguments

    module = import_module(module_name)
    add_arguments(parser, getattr(module, "ARGUMENTS", ()))
    if hasattr(module, "OPTION_GROUP"):
        from ros2cli.plugin_system import define_options

        define_options(module.OPTION_GROUP, parser, prog, words)
    if hasattr(module, "main"):
        parser.set_defaults(module=module, parser=parser)
    else:
        parser.set_defaults(show_help=parser.print_help)
    if hasattr(module, "VERB_GROUP"):
        _add_choices(parser, prog, module.VERB_GROUP, words)


def _status(args: argparse.Namespace) -> int:
    module: ModuleType | None = getattr(args, "module", None)
    if module is None:
        args.show_help()
        return 0
    from ros2cli.output import escaped_output, tell

    # launch passes on the colours of its processes, and escapes nothing that it did not write
    escaped = nullcontext() if getattr(module, "PASSES_COLOURS_ON", False) else escaped_output()
    try:
        with escaped:
            status: int | str | None = module.main(args)
    except RuntimeError as error:
        status = _told(error)
    except Exception as error:  # noqa: BLE001  the user gets one line, which names the class
        import traceback

        status = "".join(traceback.format_exception_only(type(error), error)).rstrip("\n")
        status += f"\n{error.hint}" if hasattr(error, "hint") else ""
    if isinstance(status, str):
        tell(status)
        return 1
    return status or 0


def _told(error: RuntimeError) -> str:
    hint = getattr(error, "hint", "")
    return f"{error}\n{hint}" if hint else str(error)


def _words_to_complete() -> list[str]:
    """Return the words of the command line for which the shell asks completions."""
    return os.environ.get("COMP_LINE", "").split()[1:] if "_ARGCOMPLETE" in os.environ else []
