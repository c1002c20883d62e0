"""Publishers."""

from __future__ import annotations

import itertools
import time
from typing import TYPE_CHECKING

import zenoh
from zenoh import ext

from turtlewire.errors import WireError
from turtlewire.wire.base import Publisher
from turtlewire.wire.encapsulation import joined, require_message
from turtlewire.wire.qos import Durability, History, Reliability

from .attachment import Attachment
from .endpoint import ZenohEndpoint
from .library import reason_of
from .token import PUBLISHER

if TYPE_CHECKING:
    from typing import Any

    from turtlewire.wire.base import TypeId
    from turtlewire.wire.encapsulation import Cdr
    from turtlewire.wire.qos import QoS

    from .core import ContextCore, Owner

__all__ = ["ZenohPublisher"]

#: Seconds between the messages by which a subscription notices that it missed the last one.
_HEARTBEAT = 0.5


class ZenohPublisher(ZenohEndpoint, Publisher):
    """An advanced publisher with the options that rmw_zenoh chooses for a QoS."""

    KIND = PUBLISHER

    def __init__(
        self, core: ContextCore, node: Owner, topic: str, type_id: TypeId, qos: QoS
    ) -> None:
        super().__init__(core, node, topic, type_id, qos)
        self._numbers = itertools.count(1)
        with core.calls:
            self._publisher = ext.declare_advanced_publisher(
                core.session, self.token.data_key, **_options(qos)
            )
        self.announce(self._publisher)

    def publish(self, cdr: Cdr) -> None:
        """See :meth:`Publisher.publish`."""
        cdr = joined(cdr)
        require_message(cdr, self.topic)
        attachment = Attachment(next(self._numbers), time.time_ns(), self.gid)
        with self._sending:
            if self._closed:
                raise WireError(f"publish on {self.topic}: the publisher is closed")
            try:
                with self._core.calls:
                    self._publisher.put(cdr, attachment=attachment.pack())
            except zenoh.ZError as error:
                raise WireError(f"publish on {self.topic}: {reason_of(error)}") from error

    def subscription_count(self) -> int:
        """See :meth:`Publisher.subscription_count`."""
        return len(self.partners)

    def assert_liveliness(self) -> None:
        """See :meth:`Publisher.assert_liveliness`; it is alive as long as its token is there."""

    def wait_for_acknowledgments(self, timeout_ns: int) -> bool:  # noqa: ARG002 - see below
        """See :meth:`Publisher.wait_for_acknowledgments`; Zenoh has none, so it returns at once."""
        return True


def _options(qos: QoS) -> dict[str, Any]:
    best_effort = qos.reliability == Reliability.BEST_EFFORT
    blocks = not best_effort and qos.history == History.KEEP_ALL
    congestion = zenoh.CongestionControl
    options: dict[str, Any] = {
        "congestion_control": congestion.BLOCK if blocks else congestion.DROP,
        "reliability": zenoh.Reliability.BEST_EFFORT if best_effort else zenoh.Reliability.RELIABLE,
    }
    if qos.durability == Durability.TRANSIENT_LOCAL:
        options["cache"] = ext.CacheConfig(max_samples=max(qos.depth, 1))
        options["publisher_detection"] = True
        if not best_effort:
            options["sample_miss_detection"] = ext.MissDetectionConfig(
                heartbeat=None, sporadic_heartbeat=_HEARTBEAT
            )
    return options
