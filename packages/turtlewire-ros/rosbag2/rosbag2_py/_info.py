"""Reads metadata of bags, for ``ros2 bag info``."""

from __future__ import annotations

import contextlib
import os
from collections.abc import Iterator

from rosbag2_py._metadata import BagMetadata, info
from rosbag2_py._storage import folder_size, from_engine
from rosbag2_transport.topic_filter import is_service_event, service_of
from turtlewire.bag import Bag, open_bag
from turtlewire.errors import BagError

_REQUEST_SENT, _REQUEST_RECEIVED, _RESPONSE_SENT, _RESPONSE_RECEIVED = range(4)


class Info:
    """Reads the metadata of bags."""

    def read_metadata(self, uri: str, _storage_id: str = "") -> BagMetadata:
        """Return the metadata of a bag, from ``metadata.yaml`` or from its files.

        Raises:
            RuntimeError: The bag does not exist or cannot be read.
        """
        with _opened(uri) as bag:
            metadata = from_engine(bag.metadata, folder_size(uri))
        if not os.path.isdir(uri):
            metadata.relative_file_paths = [uri]
        return metadata

    def read_metadata_and_output_service_verbose(self, uri: str, storage_id: str = "") -> None:
        """Print the text of ``ros2 bag info --verbose``, which counts requests and responses.

        Raises:
            RuntimeError: The bag does not exist or cannot be read.
        """
        metadata = self.read_metadata(uri, storage_id)
        with _opened(uri) as bag:
            counts = service_counts(bag)
        print(info(metadata, counts))  # noqa: T201 - its purpose


def service_counts(bag: Bag) -> dict[str, tuple[int, int]]:
    """Numbers of requests and responses of each service whose events a bag holds.

    What client and server both report counts twice, as in rosbag2.
    """
    events = [topic for topic in bag.topics.values() if is_service_event(topic.name, topic.type)]
    counts = {}
    for topic in events:
        kinds = [0, 0, 0, 0]
        for message in bag.messages(topic.name):
            # The info field comes first, and its event_type is the first byte behind the header.
            if len(message.data) > 4:
                kinds[message.data[4] & 3] += 1
        requests = kinds[_REQUEST_SENT] + kinds[_REQUEST_RECEIVED]
        responses = kinds[_RESPONSE_SENT] + kinds[_RESPONSE_RECEIVED]
        counts[service_of(topic.name, topic.type)[0]] = (requests, responses)
    return counts


@contextlib.contextmanager
def _opened(uri: str) -> Iterator[Bag]:
    try:
        with open_bag(uri) as bag:
            yield bag
    except (BagError, OSError) as error:
        raise RuntimeError(str(error)) from error
