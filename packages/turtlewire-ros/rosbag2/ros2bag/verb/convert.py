"""``ros2 bag convert``."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING, Any

from ros2bag.options import STORAGES, bag_path, existing_file
from ros2bag.verb import VerbExtension
from ros2cli.arguments import argument, exclusive
from ros2cli.builtin import verb_of_module
from ros2cli.completion import files

if TYPE_CHECKING:
    from collections.abc import Sequence

__all__ = ["ARGUMENTS", "ConvertVerb", "main"]


class _Input(argparse.Action):
    """Collects ``-i URI [STORAGE_ID]``."""

    def __call__(
        self,
        _parser: argparse.ArgumentParser,
        namespace: argparse.Namespace,
        values: str | Sequence[Any] | None,
        _option: str | None = None,
    ) -> None:
        """Check one bag's words."""
        words = [str(value) for value in values or ()]
        if len(words) > 2:
            raise argparse.ArgumentError(
                self, f"expected a bag and optionally its storage, got {len(words)} words"
            )
        storage = words[1] if len(words) == 2 else ""
        if storage and storage not in STORAGES:
            raise argparse.ArgumentError(
                self, f"invalid storage '{storage}' (choose from {', '.join(STORAGES)})"
            )
        try:
            uri = bag_path(words[0])
        except argparse.ArgumentTypeError as error:
            raise argparse.ArgumentError(self, str(error)) from None
        namespace.input = [*(namespace.input or []), (uri, storage)]


ARGUMENTS = (
    exclusive(
        argument(
            "-i",
            "--input",
            action=_Input,
            nargs="+",
            metavar=("uri", "storage_id"),
            help="A bag to read, and optionally its storage; may be given several times",
            completer=files,
        ),
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


@verb_of_module
class ConvertVerb(VerbExtension):
    """Write the messages of bags into others."""
