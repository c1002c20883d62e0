"""Publishers."""

from __future__ import annotations

import itertools
import time
from typing import TYPE_CHECKING

import zenoh
from zenoh import ext

from turtlewire.errors import WireError
from turtlewire.wire.base import Publisher
from turtlewire.wire.encapsulation import is_message, joined, no_message
from turtlewire.wire.qos import Durability, History, Reliability

from .endpoint import ZenohEndpoint
from .library import reason_of
from .protocol import PUBLISHER, pack_attachment

if TYPE_CHECKING:
    from typing import Any

    from turtlewire.wire.base import TypeId
    from turtlewire.wire.encapsulation import Cdr
    from turtlewire.wire.qos import QoS

    from .context_state import Owner, ZenohContextState

#: Seconds between the messages by which a subscription notices that it missed the last one.
_HEARTBEAT = 0.5


class ZenohPublisher(ZenohEndpoint, Publisher):
    """An advanced publisher with the options that rmw_zenoh chooses for a QoS."""

    KIND = PUBLISHER

    def __init__(
        self, core: ZenohContextState, node: Owner, topic: str, type_id: TypeId, qos: QoS
    ) -> None:
        super().__init__(core, node, topic, type_id, qos)
        self._numbers = itertools.count(1)
        self._has_subscriber = False
        # What is kept for late subscriptions would fill the shared memory.
        self._memory = core.memory if self.qos.durability == Durability.VOLATILE else None
        with core.calls:
            self._publisher = ext.declare_advanced_publisher(
                core.session, self.token.data_key, **_options(self.qos)
            )
            # Publishes nothing. Bridges and storages are subscribers without a token, and only a
            # plain publisher can say that one is there.
            plain = core.session.declare_publisher(self.token.data_key)
            listener = core.threads.declare(self._on_matching, plain.declare_matching_listener)
            status: Any = plain.matching_status  # zenoh's stub calls it a bool
            if status.matching:
                self._has_subscriber = True
        self._declared += [plain, listener]
        self.announce(self._publisher)

    def _on_matching(self, status: zenoh.MatchingStatus) -> None:
        """Note, on its own thread, that the first subscriber has come or the last has gone."""
        self._has_subscriber = status.matching
        self._core.reader.submit(self._core.graph.notify_changed)

    def publish(self, cdr: Cdr) -> None:
        if type(cdr) is not bytes:
            cdr = joined(cdr)
        if not is_message(cdr):
            raise no_message(cdr, self.topic)
        attachment = pack_attachment(next(self._numbers), time.time_ns(), self.gid)
        with self._sending:
            if self._closed:
                raise WireError(f"publish on {self.topic}: the publisher is closed")
            try:
                with self._core.calls:
                    # No variable holds what is placed, since it may be freed only in here.
                    self._publisher.put(
                        cdr if self._memory is None else self._memory.placed(cdr),
                        attachment=attachment,
                    )
            except zenoh.ZError as error:
                raise WireError(f"publish on {self.topic}: {reason_of(error)}") from error

    def is_heard(self) -> bool:
        return self._has_subscriber or bool(self.partners)

    def subscription_count(self) -> int:
        return len(self.partners)

    def assert_liveliness(self) -> None:
        """Do nothing: the publisher is alive as long as its token exists."""

    def wait_for_acknowledgments(self, timeout_ns: int) -> bool:  # noqa: ARG002 - see below
        """Return True at once: Zenoh has no acknowledgments."""
        return True


def _options(qos: QoS) -> dict[str, Any]:
    reliable = qos.reliability == Reliability.RELIABLE
    blocks = reliable and qos.history == History.KEEP_ALL
    congestion = zenoh.CongestionControl
    options: dict[str, Any] = {
        "congestion_control": congestion.BLOCK if blocks else congestion.DROP,
        "reliability": zenoh.Reliability.RELIABLE if reliable else zenoh.Reliability.BEST_EFFORT,
    }
    if qos.durability == Durability.TRANSIENT_LOCAL:
        options["cache"] = ext.CacheConfig(max_samples=qos.depth)
        options["publisher_detection"] = True
        if reliable:
            options["sample_miss_detection"] = ext.MissDetectionConfig(
                heartbeat=None, sporadic_heartbeat=_HEARTBEAT
            )
    return options
