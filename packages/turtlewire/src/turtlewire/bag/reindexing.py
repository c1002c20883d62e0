"""Repairs the folder of a recorder that was cut off."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

from turtlewire.bag.metadata import write_metadata
from turtlewire.bag.reader import Bag
from turtlewire.bag.repair import DAMAGED, repaired_copy

if TYPE_CHECKING:
    from collections.abc import Callable

    from turtlewire.bag.metadata import BagMetadata

__all__ = ["reindex"]


def reindex(
    path: str | os.PathLike[str], damaged: Callable[[str], None] | None = None
) -> BagMetadata:
    """Rebuild ``metadata.yaml`` of a folder, and repair the files that were not finished.

    A file that was cut off, by a crash or a full disk, is replaced by a whole one with all that can
    be read of it. The old file keeps the name with ``.damaged`` appended.

    Args:
        path: The folder.
        damaged: Called with a sentence for each part that cannot be read.

    Raises:
        FileNotFoundError: The folder does not exist.
        BagError: The folder contains no file of a bag, or an invalid one.
    """
    problems, copies = [], []
    with Bag(path, trust_metadata=False) as bag:
        for file in bag.files():
            if file.path.startswith(bag.path):  # not a decompressed copy elsewhere
                try:
                    copies.append((file.path, repaired_copy(file)))
                except OSError as error:
                    problems.append(f"{file.path} is not repaired: {error}")
        problems = bag.problems + problems
    for name, copy in copies:
        if copy:
            os.replace(name, name + DAMAGED)
            os.replace(copy, name)
            problems.append(f"{name} is repaired; the damaged file is {name}{DAMAGED}")
    with Bag(path, trust_metadata=False) as bag:
        write_metadata(bag.path, bag.metadata)
        if damaged is not None:
            for problem in dict.fromkeys([*problems, *bag.problems]):
                damaged(problem)
        return bag.metadata
