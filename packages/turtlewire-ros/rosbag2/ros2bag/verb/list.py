"""``ros2 bag list``."""

from __future__ import annotations

import argparse

from ros2bag.verb import VerbExtension
from ros2cli.arguments import argument

_PLUGINS = {
    "storage": {
        "mcap": "the default: a file in chunks, compressed or not, with an index",
        "sqlite3": "a database",
    },
    "converter": {},
    "compressor": {"zstd": "whole files or single messages"},
    "decompressor": {"zstd": "whole files or single messages"},
}


ARGUMENTS = (
    argument("plugin_type", choices=tuple(_PLUGINS), help="What to list"),
    argument("-v", "--verbose", action="store_true", help="Also print a description of each"),
)


def main(args: argparse.Namespace) -> None:
    """Print the names."""
    for name, what in _PLUGINS[args.plugin_type].items():
        print(name)
        if args.verbose:
            print(f"\t{what}")


class ListVerb(VerbExtension, module=__name__):
    """List the storages and compressions that can be used."""
