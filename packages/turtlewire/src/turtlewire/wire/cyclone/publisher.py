"""Publishers: write bytes to a DDS writer."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, ClassVar, cast

from turtlewire.errors import WireError
from turtlewire.wire.base import EventKind, Publisher
from turtlewire.wire.encapsulation import joined, no_message

from . import library as dds
from .endpoint import (
    Endpoint,
    EndpointSpec,
    StatusSource,
    matched_handles,
    read_count,
    read_incompatible,
    read_matched,
)
from .fast_dds import FAST_DDS
from .native import NATIVE
from .qos import MAX_BLOCKING_NS, dds_qos
from .samples import CLOSED, NO_IDENTITY, NO_MESSAGE, REFUSED, make_writer
from .servers import is_fast_dds, matched_endpoints

if TYPE_CHECKING:
    from turtlewire._native import CycloneWriter
    from turtlewire.wire.base import Outlet
    from turtlewire.wire.encapsulation import Cdr

    from .participant import Participant


class CyclonePublisher(Endpoint, Publisher):
    """A DDS writer of serialized messages."""

    _sources: ClassVar[Mapping[EventKind, StatusSource]] = {
        EventKind.MATCHED: StatusSource(
            1 << 11, dds.publication_matched_status, dds.MatchedStatus, read_matched
        ),
        EventKind.INCOMPATIBLE_QOS: StatusSource(
            1 << 3, dds.offered_incompatible_status, dds.IncompatibleStatus, read_incompatible
        ),
        EventKind.DEADLINE_MISSED: StatusSource(
            1 << 1, dds.offered_deadline_status, dds.CountStatus, read_count
        ),
        EventKind.LIVELINESS_LOST: StatusSource(
            1 << 9, dds.liveliness_lost_status, dds.CountStatus, read_count
        ),
    }

    def __init__(self, participant: Participant, spec: EndpointSpec) -> None:
        super().__init__(spec)
        self.topic = spec.name
        with (
            FAST_DDS.shared_type(participant, self) as shared_type,
            participant.topic(spec.dds_topic, spec.type_id.name, shared_type) as topic,
            dds_qos(spec.qos, spec.user_data, writer=True, partition=spec.partition) as qos,
        ):
            self._created(dds.create_writer(participant.handle, topic, qos, None))
        self._writer = make_writer(self.handle)
        self._write = self._writer.write
        self._heard = False
        self.on_matched.append(self._subscriptions_changed)
        self.on_closing.append(self._writer.close)

    def publish(self, cdr: Cdr) -> None:
        code = self._write(cdr)
        if code < 0:
            self._refused(code, joined(cdr))

    def publish_identified(self, cdr: bytes, guid: bytes, number: int) -> None:
        """Send a message of a service with the identity of a request in its QoS, as Fast DDS does.

        Its type was prepared for that.
        """
        writer = cast("CycloneWriter", self._writer)
        code = writer.write_identified(cdr, guid, number)
        if code == NO_IDENTITY:
            # Without readers on Fast DDS, Cyclone makes no message that could take the identity.
            if any(map(is_fast_dds, self.subscriber_gids())):
                FAST_DDS.give_up("messages")
        elif code < 0:
            self._refused(code, cdr)

    def subscriber_gids(self) -> list[bytes]:
        """Return the gids of the matching readers."""
        matched = matched_handles(self.handle, dds.matched_subscriptions)
        found = matched_endpoints(self.handle, matched, dds.matched_subscription_data)
        return [each.gid for each in found]

    def _refused(self, code: int, cdr: bytes) -> None:
        if code == NO_MESSAGE:
            raise no_message(cdr, self.topic)
        if code == REFUSED:
            raise WireError(f"publish on {self.topic}: Cyclone DDS rejects the message")
        if code == dds.RETCODE_TIMEOUT:
            seconds = MAX_BLOCKING_NS / 1e9
            error = WireError(
                f"publish on {self.topic}: not sent, "
                f"a reliable subscription did not keep up for {seconds:g} s"
            )
            raise error.with_hint(
                "Publish less often, use a smaller depth with KEEP_LAST, "
                "or best effort reliability."
            )
        if code == CLOSED or self._closed:
            raise WireError(f"publish on {self.topic}: the publisher is closed")
        dds.check(code, f"publish on {self.topic}")

    def outlet(self) -> Outlet | None:
        return None if NATIVE is None else self._writer

    def is_heard(self) -> bool:
        return self._heard or self.subscription_count() > 0

    def _subscriptions_changed(self) -> None:
        self._heard = self.subscription_count() > 0

    def subscription_count(self) -> int:
        return max(0, int(dds.matched_subscriptions(self.handle, None, 0)))

    def assert_liveliness(self) -> None:
        dds.check(dds.assert_liveliness(self.handle), f"assert liveliness on {self.topic}")

    def wait_for_acknowledgments(self, timeout_ns: int) -> bool:
        code = dds.wait_for_acks(self.handle, dds.duration(timeout_ns))
        if code == dds.RETCODE_TIMEOUT:
            return False
        dds.check(code, f"wait for acknowledgments on {self.topic}")
        return True
