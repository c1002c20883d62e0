"""Publishers and subscriptions: bytes to and from a DDS writer and reader."""

from __future__ import annotations

import ctypes
import threading
import time
from typing import TYPE_CHECKING

from turtlewire.errors import WireError
from turtlewire.wire import names
from turtlewire.wire.base import MessageInfo, Publisher, Subscription
from turtlewire.wire.graph import format_user_data
from turtlewire.wire.report import warn_once

from . import library as dds
from .qos import MAX_BLOCKING_NS, dds_qos, read_user_data

if TYPE_CHECKING:
    from collections.abc import Callable

    from turtlewire.wire.base import TypeId
    from turtlewire.wire.qos import QoS

    from .participant import Participant
    from .reader import ReaderThread
    from .waiting import CycloneWaitSet

__all__ = ["CyclonePublisher", "CycloneSubscription", "dds_topic_name", "deliver_to"]

_LITTLE_ENDIAN = b"\x00\x01"
_BATCH = 32
_KNOWN_PUBLISHERS = 1000


def dds_topic_name(topic: str, qos: QoS) -> str:
    """The DDS name of a ROS topic."""
    return topic if qos.avoid_ros_namespace_conventions else names.topic_to_dds(topic)


def _nothing() -> None:
    """The reaction of an endpoint that nobody watches."""


class CyclonePublisher(Publisher):
    """A DDS writer of serialized messages.

    Attributes:
        on_matched: Called on the reader thread after the matching subscriptions changed.
        on_closing: Called once, before the writer is deleted.
    """

    def __init__(self, participant: Participant, dds_topic: str, type_id: TypeId, qos: QoS, *, topic: str, **user_data: str) -> None:
        self.topic = topic
        self.on_matched: Callable[[], None] = _nothing
        self.on_closing: Callable[[], None] = _nothing
        self._lock = threading.Lock()
        self._closed = False
        dds_topic_handle = participant.topic(dds_topic, type_id.name)
        with dds_qos(qos, format_user_data(**user_data, typehash=type_id.type_hash), writer=True) as pointer:
            writer = dds.create_writer(participant.handle, dds_topic_handle, pointer, None)
        self.handle = dds.check(writer, f"create a publisher of {topic}")
        dds.set_status_mask(self.handle, dds.PUBLICATION_MATCHED)
        self.gid = dds.guid_of(self.handle)
        sertype = ctypes.c_void_p()
        dds.check(dds.get_sertype(self.handle, sertype), f"create a publisher of {topic}")
        self._sertype = sertype.value

    def publish(self, cdr: bytes) -> None:
        """See :meth:`Publisher.publish`."""
        size = len(cdr)
        if size & 3:  # Cyclone sends multiples of four bytes
            cdr += b"\x00" * (-size & 3)
            size = len(cdr)
        with self._lock:  # the sertype must not go away between the test and its use
            if self._closed:
                raise WireError(f"publish on {self.topic}: the publisher is closed")
            serdata = dds.serdata_from_bytes(self._sertype, dds.SERDATA_KIND_DATA, 1, dds.IoVec(base=cdr, size=size), size)
        if not serdata:
            raise WireError(f"publish on {self.topic}: not a serialized message (header {cdr[:4].hex(' ')}, expected 00 01 00 00)")
        code = dds.write_serdata(self.handle, serdata)
        if code < 0:
            self._refused(code)

    def _refused(self, code: int) -> None:
        if code == dds.RETCODE_TIMEOUT:
            seconds = MAX_BLOCKING_NS / 1e9
            error = WireError(f"publish on {self.topic}: not sent, a reliable subscription did not keep up for {seconds:g} s")
            raise error.with_hint("Publish less often, use a smaller depth with KEEP_LAST, or best effort reliability.")
        if self._closed:
            raise WireError(f"publish on {self.topic}: the publisher is closed")
        dds.check(code, f"publish on {self.topic}")

    def clear_matched(self) -> None:
        """Reset the status that says that the matching subscriptions changed."""
        dds.publication_matched_status(self.handle, dds.MatchedStatus())

    def subscription_count(self) -> int:
        """See :meth:`Publisher.subscription_count`."""
        return max(0, int(dds.matched_subscriptions(self.handle, None, 0)))

    def close(self) -> None:
        """See :meth:`Entity.close`."""
        with self._lock:
            if self._closed:
                return
            self._closed = True
        self.on_closing()
        dds.delete(self.handle)


class CycloneSubscription(Subscription):
    """A DDS reader of serialized messages.

    Attributes:
        on_matched: Called on the reader thread after the matching publishers changed.
        on_closing: Called once, before the reader is deleted.
    """

    def __init__(
        self,
        participant: Participant,
        dds_topic: str,
        type_id: TypeId,
        qos: QoS,
        *,
        topic: str,
        ignore_local: bool = False,
        **user_data: str,
    ) -> None:
        self.topic = topic
        self.on_matched: Callable[[], None] = _nothing
        self.on_closing: Callable[[], None] = _nothing
        self._lock = threading.Lock()
        self._closed = False
        self._condition = 0
        self._wait_sets: set[CycloneWaitSet] = set()
        self._gids: dict[int, bytes] = {}
        self._user_data: dict[bytes, bytes] = {}
        self._serdata = (ctypes.c_void_p * _BATCH)()
        self._infos = (dds.SampleInfo * _BATCH)()
        dds_topic_handle = participant.topic(dds_topic, type_id.name)
        text = format_user_data(**user_data, typehash=type_id.type_hash)
        with dds_qos(qos, text, writer=False, ignore_local=ignore_local) as pointer:
            reader = dds.create_reader(participant.handle, dds_topic_handle, pointer, None)
        self.handle = dds.check(reader, f"create a subscription of {topic}")
        dds.set_status_mask(self.handle, dds.SUBSCRIPTION_MATCHED)
        self.gid = dds.guid_of(self.handle)

    def condition(self) -> int:
        """The read condition that is true while messages are waiting."""
        with self._lock:
            if not self._condition:
                condition = dds.create_read_condition(self.handle, dds.ANY_STATE)
                self._condition = dds.check(condition, f"wait for messages on {self.topic}")
            return self._condition

    @property
    def closed(self) -> bool:
        """Whether :meth:`close` was called."""
        return self._closed

    def attached_to(self, wait_set: CycloneWaitSet) -> None:
        """Remember a wait set that is to be told of :meth:`close`."""
        self._wait_sets.add(wait_set)

    def take(self, limit: int = _BATCH) -> list[tuple[bytes, MessageInfo]]:
        """See :meth:`Subscription.take`."""
        taken = []
        with self._lock:
            while limit > 0 and not self._closed:
                wanted = min(limit, _BATCH)
                count = dds.take_serdata(self.handle, self._serdata, wanted, self._infos, dds.ANY_STATE)
                taken += self._messages(count)
                limit -= wanted
                if count < wanted:
                    break
        return taken

    def _messages(self, count: int) -> list[tuple[bytes, MessageInfo]]:
        """Copy the first ``count`` samples out of the buffers."""
        messages = []
        now = time.time_ns()
        for index in range(count):
            serdata, info = self._serdata[index], self._infos[index]
            if info.valid_data:
                size = dds.serdata_size(serdata)
                data = bytes(size)  # new, and nobody else's yet: filled in place
                dds.serdata_to_bytes(serdata, 0, size, data)
                if data[:2] == _LITTLE_ENDIAN:
                    publisher = info.publication_handle
                    gid = self._gids.get(publisher) or self._gid_of(publisher)
                    messages.append((data, MessageInfo(info.source_timestamp, now, gid)))
                else:
                    self._refuse(data)
            dds.serdata_unref(serdata)
        return messages

    def _gid_of(self, publisher: int) -> bytes:
        endpoint = dds.matched_publication_data(self.handle, publisher)
        if not endpoint:  # it has gone already
            return publisher.to_bytes(16, "big")
        try:
            gid = bytes(endpoint.contents.key)
            user_data = read_user_data(endpoint.contents.qos)
        finally:
            dds.free_endpoint(endpoint)
        if len(self._gids) >= _KNOWN_PUBLISHERS:
            self._gids.clear()
            self._user_data.clear()
        self._gids[publisher] = gid
        self._user_data[gid] = user_data
        return gid

    def user_data_of(self, publisher_gid: bytes) -> bytes:
        """What the publisher of a taken message announced of itself; empty when that is not known."""
        return self._user_data.get(publisher_gid, b"")

    def _refuse(self, data: bytes) -> None:
        warn_once(f"header {self.topic}", f"dropped a message on {self.topic}: header {data[:4].hex(' ')} is not little endian CDR (00 01)")

    def clear_matched(self) -> None:
        """Reset the status that says that the matching publishers changed."""
        dds.subscription_matched_status(self.handle, dds.MatchedStatus())

    def publisher_count(self) -> int:
        """See :meth:`Subscription.publisher_count`."""
        return max(0, int(dds.matched_publications(self.handle, None, 0)))

    def close(self) -> None:
        """See :meth:`Entity.close`."""
        with self._lock:
            if self._closed:
                return
            self._closed = True
        for wait_set in self._wait_sets:
            wait_set.forget(self)
        self.on_closing()
        dds.delete(self.handle)


def deliver_to(subscription: CycloneSubscription, on_message: Callable[[bytes, MessageInfo], None]) -> Callable[[], None]:
    """What the reader thread calls when messages are waiting on a subscription."""

    def deliver() -> None:
        for data, info in subscription.take():
            if subscription.closed:
                return
            try:
                on_message(data, info)
            except Exception as error:  # noqa: BLE001, PERF203 - the reader thread serves others too
                warn_once(f"on_message {subscription.topic}", f"a message on {subscription.topic} was lost, its callback raised {error!r}")

    return deliver
