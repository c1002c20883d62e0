"""Subscriptions: read bytes from a DDS reader."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from contextlib import ExitStack
from typing import TYPE_CHECKING, ClassVar

from turtlewire.wire.base import EventKind, MessageInfo, Subscription
from turtlewire.wire.encapsulation import LITTLE_ENDIAN
from turtlewire.wire.graph import parse_user_data
from turtlewire.wire.reader_thread import deliver
from turtlewire.wire.report import warn_once

from . import library as dds
from .endpoint import (
    Endpoint,
    EndpointSpec,
    StatusSource,
    matched_handles,
    read_count,
    read_incompatible,
    read_liveliness_changed,
    read_matched,
)
from .fast_dds import FAST_DDS
from .native import NATIVE, Inlet
from .qos import dds_qos, read_user_data
from .samples import take_messages

if TYPE_CHECKING:
    from turtlewire.wire.base import Sink, WaitSet

    from .participant import Participant

_BATCH = 32
_EVERYTHING = 1_000_000
#: How the stand-in begins for the gid of a publisher that left before it was asked for it; the
#: number follows by which Cyclone knew it. A gid begins with the number of a vendor.
_NO_GID = bytes(8)


def is_identified(gid: bytes) -> bool:
    """Return False if the publisher of a message left before its gid was known."""
    return not gid.startswith(_NO_GID)


class CycloneSubscription(Endpoint, Subscription):
    """A DDS reader of serialized messages.

    Attributes:
        wait_sets: Those that it is attached to.
        inlet: How messages reach the sink that it was made with.
    """

    _sources: ClassVar[Mapping[EventKind, StatusSource]] = {
        EventKind.MATCHED: StatusSource(
            1 << 12, dds.subscription_matched_status, dds.MatchedStatus, read_matched
        ),
        EventKind.INCOMPATIBLE_QOS: StatusSource(
            1 << 4, dds.requested_incompatible_status, dds.IncompatibleStatus, read_incompatible
        ),
        EventKind.DEADLINE_MISSED: StatusSource(
            1 << 2, dds.requested_deadline_status, dds.CountStatus, read_count
        ),
        EventKind.LIVELINESS_CHANGED: StatusSource(
            1 << 10,
            dds.liveliness_changed_status,
            dds.LivelinessChangedStatus,
            read_liveliness_changed,
        ),
        EventKind.MESSAGE_LOST: StatusSource(
            1 << 5, dds.sample_lost_status, dds.CountStatus, read_count
        ),
    }

    def __init__(
        self,
        participant: Participant,
        spec: EndpointSpec,
        *,
        ignore_local: bool = False,
        sink: Sink | None = None,
    ) -> None:
        super().__init__(spec)
        self.topic = spec.name
        self.wait_sets: set[WaitSet] = set()
        self._condition = 0
        self._gids: dict[int, bytes] = {}
        self._user_data: dict[bytes, bytes] = {}
        self._forget = False
        self.on_matched.append(self._publishers_changed)
        self.inlet = None
        listener = None
        with (
            ExitStack() as if_it_fails,
            FAST_DDS.shared_type(participant, self) as shared_type,
            participant.topic(spec.dds_topic, spec.type_id.name, shared_type) as topic,
            dds_qos(spec.qos, spec.user_data, writer=False, ignore_local=ignore_local) as qos,
        ):
            if sink is not None and NATIVE is not None:
                self.inlet = Inlet(NATIVE, participant.handle, sink)
                if_it_fails.callback(self.inlet.close)
                listener = self.inlet.listener
            self._created(dds.create_reader(participant.handle, topic, qos, listener))
            if_it_fails.pop_all()

    def condition(self) -> int:
        """Return the condition that is true while messages are waiting."""
        if self.inlet is not None:
            return self.inlet.guard
        with self._lock:
            if not self._condition:
                condition = dds.create_read_condition(self.handle, dds.ANY_STATE)
                self._condition = dds.check(condition, f"wait for messages on {self.topic}")
            return self._condition

    def take(self, limit: int = _BATCH) -> list[tuple[bytes, MessageInfo]]:
        with self._lock:
            if self._closed:
                return []
            if self.inlet is not None:
                return self._take_left(self.inlet)
            taken = take_messages(self.handle, limit)
            messages = self._messages_of(taken)
            if self._forget and len(taken) < limit:  # with more to come, their senders are needed
                self._forget_publishers({publisher for _, publisher, _ in taken})
            return messages

    def take_rest(self, inlet: Inlet) -> list[tuple[bytes, MessageInfo]] | None:
        """Take the messages that a sink left, readable or not; None if it left nothing."""
        kept = inlet.rest(self._known_gid)
        messages = self._messages_of(kept)
        if self._forget and not kept:
            self._forget_publishers(set())
        return messages if kept else None

    def _take_left(self, inlet: Inlet) -> list[tuple[bytes, MessageInfo]]:
        """Take the messages that a sink left; the subscription stays ready until all are taken."""
        while (rest := self.take_rest(inlet)) is not None:
            if rest:
                inlet.call_again()
                return rest
        return []

    def _known_gid(self, publisher: int) -> bytes:
        """Return the gid of a publisher; empty if it has gone already."""
        gid = self._gids.get(publisher) or self._gid_of(publisher)
        return gid if publisher in self._gids else b""

    def _messages_of(self, taken: list[tuple[bytes, int, int]]) -> list[tuple[bytes, MessageInfo]]:
        """Return the readable messages."""
        now = time.time_ns()
        return [
            (data, MessageInfo(sent, now, self._gids.get(publisher) or self._gid_of(publisher)))
            for data, publisher, sent in taken
            if data[:2] == LITTLE_ENDIAN or self._refuse(data)
        ]

    def take_bytes(self) -> list[bytes]:
        """Return all waiting messages, readable or not, if it does not matter who sent them."""
        return [data for data, _, _ in take_messages(self.handle, _EVERYTHING)]

    def learn_publishers(self) -> None:
        """Ask at once who the matching publishers are: one that has left cannot be asked."""
        with self._lock:
            for publisher in matched_handles(self.handle, dds.matched_publications):
                if publisher not in self._gids:
                    self._gid_of(publisher)

    def _publishers_changed(self) -> None:
        self._forget = True

    def _forget_publishers(self, senders: set[int]) -> None:
        """Forget the publishers that left, except the ``senders`` of the messages just taken."""
        self._forget = False
        there = senders.union(matched_handles(self.handle, dds.matched_publications))
        for publisher in self._gids.keys() - there:
            self._user_data.pop(self._gids.pop(publisher), None)

    def _gid_of(self, publisher: int) -> bytes:
        endpoint = dds.matched_publication_data(self.handle, publisher)
        if not endpoint:  # it has gone already
            return publisher.to_bytes(len(_NO_GID) + 8, "big")
        try:
            gid = bytes(endpoint.contents.key)
            user_data = read_user_data(endpoint.contents.qos)
        finally:
            dds.free_endpoint(endpoint)
        self._gids[publisher] = gid
        self._user_data[gid] = user_data
        self._compare_types(parse_user_data(user_data).get("typehash", ""))
        return gid

    def _compare_types(self, theirs: str) -> None:
        """Warn of a publisher whose definition of the type has other fields.

        DDS matches types by name, so only the hash shows it; foreign peers announce none.
        """
        ours = self.spec.type_id
        if theirs and theirs != ours.type_hash:
            warn_once(
                f"type {self.topic} {theirs}",
                f"a peer on {self.topic} has another definition of {ours.name}: its messages may "
                "be rejected or decoded wrongly. "
                f"Both sides need the same version of {ours.name.partition('/')[0]} (type hash "
                f"there {theirs}, here {ours.type_hash}).",
            )

    def user_data_of(self, publisher_gid: bytes) -> bytes:
        """Return the USER_DATA of a taken message's publisher.

        Empty when that is not known.
        """
        return self._user_data.get(publisher_gid, b"")

    def _refuse(self, data: bytes) -> bool:
        warn_once(
            f"header {self.topic}",
            f"dropped a message on {self.topic}: header {data[:4].hex(' ')} is not little endian "
            "CDR (00 01)",
        )
        return False

    def publisher_count(self) -> int:
        return max(0, int(dds.matched_publications(self.handle, None, 0)))

    def _close(self) -> None:
        for wait_set in list(self.wait_sets):
            wait_set.detach(self)
        super()._close()

    def _delete(self) -> None:
        # An inlet must end after the reader that calls it, so the reader is deleted now.
        self.ends_with_participant = self.ends_with_participant and self.inlet is None
        super()._delete()
        if self.inlet is not None:
            self.inlet.close()


def deliver_to(
    subscription: CycloneSubscription, on_message: Callable[[bytes, MessageInfo], None]
) -> Callable[[], None]:
    """Return the function that the reader thread calls when messages wait."""
    return lambda: deliver(subscription.take(), on_message, lambda: subscription.closed)


def deliver_rest_to(
    subscription: CycloneSubscription,
    inlet: Inlet,
    on_message: Callable[[bytes, MessageInfo], None],
) -> Callable[[], None]:
    """:func:`deliver_to` of a subscription with a sink.

    What the reader thread calls when the inlet's guard is triggered.
    """

    def deliver_rest() -> None:
        while not subscription.closed and (rest := subscription.take_rest(inlet)) is not None:
            deliver(rest, on_message, lambda: subscription.closed)

    return deliver_rest
