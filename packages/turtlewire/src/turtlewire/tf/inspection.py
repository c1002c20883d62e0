"""What a buffer has received: senders and rates of links, refused transforms, and conflicts.

Also saves a buffer to a file and loads it again.
"""

from __future__ import annotations

import io
import os
from typing import TYPE_CHECKING

from turtlewire.tf.faults import Conflict, Malformed, Refused, conflicts, malformed, refusals
from turtlewire.tf.links import LinkInfo, Sender, links

if TYPE_CHECKING:
    from os import PathLike

    from turtlewire.tf.buffer import Buffer
    from turtlewire.tf.implementation import BaseBuffer

__all__ = [
    "Conflict",
    "LinkInfo",
    "Malformed",
    "Refused",
    "Sender",
    "conflicts",
    "dumps",
    "links",
    "load",
    "loads",
    "malformed",
    "refusals",
    "save",
]


def save(buffer: BaseBuffer, path: str | PathLike[str]) -> None:
    """Write all samples and static transforms to a file.

    The format is NumPy's ``.npz``, without pickled objects.
    """
    from turtlewire.tf import archive

    with open(path, "wb") as file:
        archive.write(buffer, file)


def dumps(buffer: BaseBuffer) -> bytes:
    """Return the bytes that :func:`save` writes."""
    from turtlewire.tf import archive

    file = io.BytesIO()
    archive.write(buffer, file)
    return file.getvalue()


def load(path: str | PathLike[str]) -> Buffer:
    """Return a new buffer with what ``save`` wrote.

    Memory and time stay in proportion to the size of the file, whatever it contains.

    Raises:
        ValueError: The file is something else, or damaged.
    """
    from turtlewire.tf import archive
    from turtlewire.tf.buffer import Buffer

    with open(path, "rb") as file:
        return archive.read(file, os.fspath(path), Buffer)


def loads(data: bytes) -> Buffer:
    """Return a new buffer with what ``dumps`` returned; see `load`."""
    from turtlewire.tf import archive
    from turtlewire.tf.buffer import Buffer

    return archive.read(io.BytesIO(data), "this", Buffer)
