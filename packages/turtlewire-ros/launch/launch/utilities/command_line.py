"""Arguments of launch files on a command line, and the text that shows them."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from launch.substitution import described

if TYPE_CHECKING:
    from launch.launch_description_entity import LaunchArgument


def parse_arguments(words: Iterable[str]) -> list[tuple[str, str]]:
    """Return the ``name:=value`` pairs, the last one of each name.

    Raises:
        RuntimeError: A word is not a pair.
    """
    values: dict[str, str] = {}
    for word in words:
        name, separator, value = word.partition(":=")
        if not separator or not name or not value:
            raise RuntimeError(
                f"malformed launch argument '{word}', expected format '<name>:=<value>'"
            )
        values[name] = value
    return list(values.items())


def describe_arguments(arguments: Iterable[LaunchArgument]) -> str:
    """Return names, descriptions and defaults of declared arguments, as ``--show-args`` does."""
    lines = ["Arguments (pass arguments as '<name>:=<value>'):"]
    conditional = False
    for declared in arguments:
        conditional |= declared.conditionally_included
        star = "*" if declared.conditionally_included else ""
        lines += [
            "",
            f"    '{declared.name}'{star}:",
            *(f"        {line}" for line in declared.description.splitlines()),
        ]
        if declared.default_value is not None:
            # As in ROS 2, unevaluated: $(eval) and $(command) would run code from the file.
            lines.append(f"        (default: {described(declared.default_value)})")
    if len(lines) == 1:
        lines += ["", "  No arguments."]
    if conditional:
        lines += ["", "* argument(s) which are only used if specific conditions occur"]
    return "\n".join(lines)
