"""Converts QoS to Cyclone's objects and back."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from ctypes import c_char_p, c_int, c_int32, c_int64, c_size_t, c_void_p, string_at
from typing import Any

from turtlewire.wire.qos import INFINITE_NS, Durability, History, Liveliness, QoS, Reliability

from . import library as dds

#: How long a write may wait for reliable subscriptions that do not keep up.
MAX_BLOCKING_NS = 1_000_000_000

_KEEP_LAST, _KEEP_ALL = 0, 1
_BEST_EFFORT, _RELIABLE = 0, 1
_VOLATILE, _TRANSIENT_LOCAL = 0, 1
_AUTOMATIC, _MANUAL_BY_TOPIC = 0, 2
_IGNORE_LOCAL_PARTICIPANT = 1
_UNLIMITED = -1

# dds_qos_policy_id_t to rmw_qos_policy_kind_t: durability, deadline, liveliness, reliability,
# history, lifespan
_POLICY_KINDS = {2: 2, 4: 4, 8: 8, 11: 16, 13: 32, 21: 64}
_POLICY_KIND_INVALID = 1
_LIVELINESS = {_AUTOMATIC: Liveliness.AUTOMATIC, _MANUAL_BY_TOPIC: Liveliness.MANUAL_BY_TOPIC}


@contextmanager
def dds_qos(
    qos: QoS, user_data: bytes, *, writer: bool, ignore_local: bool = False, partition: str = ""
) -> Iterator[int]:
    """A ``dds_qos_t`` for one endpoint, with the policies that rmw_cyclonedds sets."""
    pointer = dds.create_qos()
    try:
        _set_history_and_durability(pointer, qos)
        reliable = qos.reliability != Reliability.BEST_EFFORT
        dds.qset_reliability(
            pointer,
            _RELIABLE if reliable else _BEST_EFFORT,
            MAX_BLOCKING_NS if writer else INFINITE_NS,
        )
        if writer:
            dds.qset_writer_data_lifecycle(pointer, False)
            if qos.lifespan_ns:
                dds.qset_lifespan(pointer, qos.lifespan_ns)
        if qos.deadline_ns:
            dds.qset_deadline(pointer, qos.deadline_ns)
        manual = qos.liveliness == Liveliness.MANUAL_BY_TOPIC
        dds.qset_liveliness(
            pointer,
            _MANUAL_BY_TOPIC if manual else _AUTOMATIC,
            qos.liveliness_lease_ns or INFINITE_NS,
        )
        if ignore_local:
            dds.qset_ignore_local(pointer, _IGNORE_LOCAL_PARTICIPANT)
        if partition:
            dds.qset_partition(pointer, 1, (c_char_p * 1)(partition.encode()))
        dds.qset_user_data(pointer, user_data, len(user_data))
        yield pointer
    finally:
        dds.delete_qos(pointer)


def _set_history_and_durability(pointer: int, qos: QoS) -> None:
    if qos.history == History.KEEP_ALL:
        kind, depth = _KEEP_ALL, _UNLIMITED
    else:
        kind, depth = _KEEP_LAST, max(qos.depth, 1)
    dds.qset_history(pointer, kind, depth)
    if qos.durability == Durability.TRANSIENT_LOCAL:
        dds.qset_durability(pointer, _TRANSIENT_LOCAL)
        dds.qset_durability_service(pointer, 0, kind, depth, _UNLIMITED, _UNLIMITED, _UNLIMITED)
    else:
        dds.qset_durability(pointer, _VOLATILE)


def read_qos(pointer: int) -> QoS:
    """Read the ``dds_qos_t`` of a discovered endpoint.

    What it does not say stays at our defaults.
    """
    kind, number, duration = c_int(), c_int32(), c_int64()
    values: dict[str, Any] = {}
    if dds.qget_history(pointer, kind, number):
        values["history"] = History.KEEP_ALL if kind.value == _KEEP_ALL else History.KEEP_LAST
        values["depth"] = max(number.value, 0)
    if dds.qget_reliability(pointer, kind, duration):
        values["reliability"] = (
            Reliability.RELIABLE if kind.value == _RELIABLE else Reliability.BEST_EFFORT
        )
    if dds.qget_durability(pointer, kind):
        values["durability"] = (
            Durability.VOLATILE if kind.value == _VOLATILE else Durability.TRANSIENT_LOCAL
        )
    if dds.qget_deadline(pointer, duration):
        values["deadline_ns"] = duration.value
    if dds.qget_lifespan(pointer, duration):
        values["lifespan_ns"] = duration.value
    if dds.qget_liveliness(pointer, kind, duration):
        values["liveliness"] = _LIVELINESS.get(kind.value, Liveliness.UNKNOWN)
        values["liveliness_lease_ns"] = duration.value
    return QoS()._replace(**values)


def read_user_data(pointer: int) -> bytes:
    """Return the user data of a discovered participant or endpoint."""
    data, size = c_void_p(), c_size_t()
    if not dds.qget_user_data(pointer, data, size) or not data.value:
        return b""
    try:
        return string_at(data.value, size.value)
    finally:
        dds.free(data)


def policy_kind(policy_id: int) -> int:
    """Return the number that ROS 2 has for a policy of DDS."""
    return _POLICY_KINDS.get(policy_id, _POLICY_KIND_INVALID)
