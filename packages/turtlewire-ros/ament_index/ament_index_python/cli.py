"""``python -m ament_index_python.cli``: resources of the index on the command line."""

from __future__ import annotations

import argparse
import sys
from typing import Any

from ament_index_python.resources import get_resource, get_resource_types, get_resources
from turtlewire.program import program


def main(argv: list[str] = sys.argv[1:]) -> str | None:
    """Print the types, the names of a type, or a resource.

    Args:
        argv: Nothing, a type, or a type and a name.

    Returns:
        The text of an error, or None.
    """
    parser = argparse.ArgumentParser(
        prog="ament_index", description="Query the ament resource index."
    )
    for name, completer in (("type", resource_type_completer), ("name", resource_name_completer)):
        word = parser.add_argument(
            f"resource_{name}", nargs="?", metavar=name.upper(), help=f"{name} of the resource"
        )
        word.completer = completer  # type: ignore[attr-defined]  # argcomplete's convention
    args = parser.parse_args(argv)
    if args.resource_type is None:
        print(*sorted(get_resource_types()), sep="\n")
    elif args.resource_name is None:
        for name, prefix in sorted(get_resources(args.resource_type).items()):
            print(f"{name}\t{prefix}")
    else:
        try:
            content, prefix = get_resource(args.resource_type, args.resource_name)
        except LookupError:
            return (
                f"Could not find the resource '{args.resource_name}' of type '{args.resource_type}'"
            )
        print(prefix)
        if content:
            print(content)
    return None


def resource_type_completer(prefix: str, **kwarg: Any) -> list[str]:  # noqa: ARG001
    """Return the types that begin with the prefix."""
    return [name for name in get_resource_types() if name.startswith(prefix)]


def resource_name_completer(
    prefix: str,
    parsed_args: argparse.Namespace,
    **kwargs: Any,  # noqa: ARG001  argcomplete's arguments
) -> list[str]:
    """Return the names of the type on the command line that begin with the prefix."""
    found = get_resources(parsed_args.resource_type)
    return [name for name in found if name.startswith(prefix)]


if __name__ == "__main__":
    sys.exit(program(main)())
