"""Requests to servers on Fast DDS."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import TYPE_CHECKING

from .servers import Servers, is_fast_dds

if TYPE_CHECKING:
    from .publisher import CyclonePublisher
    from .servers import MatchedEndpoint


class IdentifiedRequests:
    """Sends requests with their identity in the inline QoS.

    Args:
        requests: A separate writer, which Fast DDS matches. It does not match the writer of
            requests in Cyclone's layout, so it can never receive one of those.
        reader: The GUID of the reader of replies.
        refuse: Raises if one of the servers that match would misread a request.
    """

    def __init__(
        self,
        requests: CyclonePublisher,
        reader: bytes,
        refuse: Callable[[list[MatchedEndpoint]], None],
    ) -> None:
        self.requests = requests
        self.servers = Servers(requests.handle)
        self._reader = reader
        self._refuse = refuse
        self._lock = threading.Lock()
        self._sent = 0

    def send(self, cdr: bytes) -> int | None:
        """Send a request, unless servers on Cyclone have just replaced the ones on Fast DDS.

        Returns:
            The sequence number that the reply will carry; None if nothing was sent.
        """
        from turtlewire._native import NUMBER_OF_SAMPLE

        with self._lock:
            servers = self.servers.now()
            self._refuse(servers)
            if not all(is_fast_dds(server.gid) for server in servers):
                return None
            # Without its identity, the request would still be valid: the reply would name the
            # writer.
            self.requests.publish_identified(cdr, self._reader, NUMBER_OF_SAMPLE)
            # DDS numbers the samples of a writer in the same way: this is the sample's number.
            self._sent += 1
            return self._sent

    def is_ours(self, guid: bytes) -> bool:
        """Return True if a reply with this GUID answers one of the requests."""
        return guid in {self._reader, self.requests.gid}
