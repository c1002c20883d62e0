"""``ros2 bag convert``."""

from __future__ import annotations

import argparse

from ros2bag.options import INPUT, existing_file
from ros2bag.verb import VerbExtension
from ros2cli.arguments import argument, exclusive
from ros2cli.completion import files

ARGUMENTS = (
    exclusive(
        INPUT,
        argument(
            "--input-options",
            metavar="FILE",
            type=existing_file,
            help="YAML file whose key input_bags lists the bags to read",
            completer=files,
        ),
        required=True,
    ),
    argument(
        "-o",
        "--output-options",
        required=True,
        help="YAML file whose key output_bags lists the bags to write",
        completer=files,
    ),
)


def main(args: argparse.Namespace) -> None:
    """Write the messages of the bags into others."""
    from rosbag2_py import StorageOptions, bag_rewrite
    from rosbag2_py._rewrite import input_bags

    inputs = (
        [StorageOptions(uri=uri, storage_id=storage) for uri, storage in args.input]
        if args.input_options is None
        else input_bags(args.input_options)
    )
    bag_rewrite(inputs, args.output_options)


class ConvertVerb(VerbExtension, module=__name__):
    """Write the messages of bags into others."""
