"""Makes ``metadata.yaml`` anew from the files of a bag."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

from turtlewire.bag import reindex
from turtlewire.errors import BagError

if TYPE_CHECKING:
    from rosbag2_py._storage import StorageOptions

__all__ = ["Reindexer"]


class Reindexer:
    """Repairs bags whose recorder was killed."""

    def reindex(self, storage_options: StorageOptions) -> None:
        """Write the metadata of the bag at ``storage_options.uri``.

        Raises:
            RuntimeError: It is no folder with files of a bag.
        """
        if not os.path.isdir(storage_options.uri):
            raise RuntimeError(f"{storage_options.uri} is not a bag directory")
        try:
            reindex(storage_options.uri)
        except BagError as error:
            raise RuntimeError(str(error)) from error
