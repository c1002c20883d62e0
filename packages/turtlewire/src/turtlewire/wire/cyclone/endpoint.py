"""The common base of publishers and subscriptions.

It has an identity in the graph, and statuses that change.
"""

from __future__ import annotations

import ctypes
import os
import threading
from collections.abc import Callable, Mapping
from contextlib import ExitStack
from typing import TYPE_CHECKING, ClassVar, NamedTuple

from turtlewire.errors import WireError
from turtlewire.guarded import call_guarded
from turtlewire.wire.base import Entity, EventKind, EventStatus
from turtlewire.wire.events import EventSource
from turtlewire.wire.graph import format_user_data

from . import library as dds
from .qos import policy_kind

if TYPE_CHECKING:
    from turtlewire.wire.base import Event, TypeId
    from turtlewire.wire.qos import QoS


class EndpointSpec(NamedTuple):
    """The specification of a new endpoint.

    Attributes:
        name: ROS name of the topic or service, for messages to people.
        dds_topic: Name on the wire.
        type_id: Type on the wire.
        qos: What is offered or requested.
        identity: ``clientid`` or ``serviceid`` of one half of a service, and ``sertypehash`` if it
            is announced; empty for topics.
        partition: The DDS partition; empty for the default one.
    """

    name: str
    dds_topic: str
    type_id: TypeId
    qos: QoS
    identity: dict[str, str] = {}  # noqa: RUF012 - never changed
    partition: str = ""

    @property
    def carries_identities(self) -> bool:
        """True if it is a half of a service that nodes on Fast DDS can match."""
        return bool(self.identity) and not self.partition

    @property
    def user_data(self) -> bytes:
        """USER_DATA announced with the QoS."""
        return format_user_data(**self.identity, typehash=self.type_id.type_hash)


class StatusSource(NamedTuple):
    """The source of an event's counters.

    The status bit, the function that reads and resets them, and their translation.
    """

    bit: int
    read: Callable[..., int]
    structure: type[ctypes.Structure]
    translate: Callable[..., EventStatus]


class Endpoint(EventSource, Entity):
    """A DDS reader or writer.

    Attributes:
        handle: Cyclone's handle of it.
        gid: Its 16 bytes.
        on_matched: Each is called on the reader thread after the matching endpoints changed.
        on_closing: Each is called once, before it is deleted.
        ends_with_participant: Whether the participant is about to be deleted, and all that it has
            with it: that takes half the time.
        shared_type: Address of the type of service messages that it was made with; 0 if none.
    """

    handle: int
    gid: bytes
    shared_type = 0
    _sources: ClassVar[Mapping[EventKind, StatusSource]]

    def __init__(self, spec: EndpointSpec) -> None:
        super().__init__(threading.Lock())
        self.spec = spec
        self.on_matched: list[Callable[[], None]] = []
        self.on_closing: list[Callable[[], None]] = []
        self.ends_with_participant = False
        self._closed = False
        self._process = os.getpid()

    def _created(self, handle: int) -> None:
        """Store the new reader or writer; raises if creating it failed."""
        self.handle = dds.check(handle, f"create an endpoint of {self.spec.name}")
        with ExitStack() as if_it_fails:
            if_it_fails.callback(dds.delete, handle)
            self.gid = dds.guid_of(self.handle)
            if_it_fails.pop_all()
        dds.set_status_mask(self.handle, sum(source.bit for source in self._sources.values()))

    @property
    def closed(self) -> bool:
        """True if :meth:`close` was called."""
        return self._closed

    @property
    def is_inherited(self) -> bool:
        """True in a forked child: Cyclone's locks may be held for good; see `Entity.close`."""
        return self._process != os.getpid()

    def create_event(self, kind: EventKind) -> Event:
        if kind not in self._sources and kind is not EventKind.INCOMPATIBLE_TYPE:
            raise WireError(
                f"{type(self).__name__} of {self.spec.name} has no event '{kind.value}'"
            )
        return self._event(kind)

    def statuses_changed(self) -> None:
        """Read, reset and forward all changed statuses; runs on the reader thread."""
        changed = ctypes.c_uint32()
        if dds.get_status_changes(self.handle, changed) < 0:
            return  # it has been deleted
        news: list[tuple[EventKind, EventStatus]] = []
        # Read before the callbacks, because reading resets a status: a match that arrives after the
        # callbacks but before the read would never be reported.
        for kind, source in self._sources.items():
            if changed.value & source.bit:
                status = source.structure()
                source.read(self.handle, status)
                news.append((kind, source.translate(status)))
        # Before the events, which find what the callbacks set.
        if changed.value & self._sources[EventKind.MATCHED].bit:
            for call in self.on_matched:
                call_guarded(call)
        for kind, translated in news:
            self._event(kind).add(translated)

    def close(self) -> None:
        if not self.is_inherited:
            self._close()

    def _close(self) -> None:
        with self._lock:
            if self._closed:
                return
            self._closed = True
        # Before the deletion: the callbacks still use the handle.
        for call in self.on_closing:
            call()
        self._close_events()
        self._delete()

    def _delete(self) -> None:
        if not self.ends_with_participant:
            dds.delete(self.handle)


def read_count(status: dds.CountStatus) -> EventStatus:
    """Convert the status of missed deadlines, lost liveliness or lost messages."""
    return EventStatus(status.total_count, status.total_count_change)


def read_incompatible(status: dds.IncompatibleStatus) -> EventStatus:
    """Convert the status of endpoints with an incompatible QoS."""
    return EventStatus(
        status.total_count,
        status.total_count_change,
        last_policy_kind=policy_kind(status.last_policy_id),
    )


def read_matched(status: dds.MatchedStatus) -> EventStatus:
    """Convert the status of matched endpoints."""
    return EventStatus(
        status.total_count,
        status.total_count_change,
        status.current_count,
        status.current_count_change,
    )


def read_liveliness_changed(status: dds.LivelinessChangedStatus) -> EventStatus:
    """Liveliness changed."""
    return EventStatus(
        status.not_alive_count,
        status.not_alive_count_change,
        status.alive_count,
        status.alive_count_change,
    )


def matched_handles(handle: int, list_matched: Callable[..., int]) -> list[int]:
    """Cyclone's handles of the readers or writers that match."""
    count = list_matched(handle, None, 0)
    while count > 0:
        found = (ctypes.c_uint64 * count)()
        total = list_matched(handle, found, count)
        if total <= count:
            return list(found[: max(total, 0)])
        count = total  # one more came in between
    return []
