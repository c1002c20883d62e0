"""Rebuilds ``metadata.yaml`` from the files of a bag."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

from rclpy.logging import get_logger
from turtlewire.bag import reindex
from turtlewire.errors import BagError
from turtlewire.terminal.printable import printable
from turtlewire.wording import counted

if TYPE_CHECKING:
    from rosbag2_py._storage import StorageOptions


class Reindexer:
    """Repairs bags whose recorder was killed."""

    def reindex(self, storage_options: StorageOptions) -> None:
        """Write the metadata of the bag at ``storage_options.uri``.

        What is damaged is logged as warnings, with what was kept.

        Raises:
            RuntimeError: The path is not a folder with files of a bag.
        """
        if not os.path.isdir(storage_options.uri):
            raise RuntimeError(f"{storage_options.uri} is not a bag directory")
        damaged: list[str] = []
        try:
            found = reindex(storage_options.uri, damaged.append)
        except (BagError, OSError) as error:
            raise RuntimeError(str(error)) from error
        if damaged:
            logger = get_logger("rosbag2_cpp")
            for problem in damaged:
                logger.warning(printable(problem))
            files = counted(len(found.paths), "file")
            kept = f"{counted(found.message_count, 'message')} in {files}"
            logger.warning(f"The bag is damaged; kept: {kept}.")
