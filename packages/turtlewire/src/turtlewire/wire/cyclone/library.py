"""Loads ``libddsc``, and declares the functions that we call.

A function is declared in one of two ways:

- ``_waits``: it may block or take long; ctypes releases the GIL around it.
- ``_short``: it never waits for anything but a short internal lock; it keeps the GIL, which is
  several times cheaper and cannot deadlock, because no thread of Cyclone's ever needs the GIL.
"""

from __future__ import annotations

import ctypes
import sys
from collections.abc import Callable
from ctypes import (
    POINTER,
    c_bool,
    c_char,
    c_char_p,
    c_int,
    c_int32,
    c_int64,
    c_size_t,
    c_uint8,
    c_uint32,
    c_uint64,
    c_void_p,
)
from typing import Any

from turtlewire.errors import WireError
from turtlewire.wire.libddsc import Abi, Libddsc, find_libddsc
from turtlewire.wire.qos import INFINITE_NS
from turtlewire.wire.report import warn_once

ANY_STATE = 127
WHOLE_LIBRARY = 0x7FFF_0100  # what all domains of the process belong to
BUILTIN_TOPIC_PARTICIPANT = 0x7FFF_0001
BUILTIN_TOPIC_PUBLICATION = 0x7FFF_0003
BUILTIN_TOPIC_SUBSCRIPTION = 0x7FFF_0004
INSTANCE_ALIVE = 16
SERDATA_KIND_DATA = 2

RETCODE_PRECONDITION_NOT_MET = -4
RETCODE_TIMEOUT = -10


def _find() -> tuple[Libddsc, Abi]:
    library, refused = find_libddsc()
    if library is not None and library.abi is not None:
        for sentence in refused:
            warn_once(sentence, f"{sentence}: {library} is used")
        return library, library.abi
    from turtlewire.wire.wheels import advice, this_platform

    here = this_platform()
    version = ".".join(map(str, here.version))
    error = WireError(
        f"Cyclone DDS is not available for Python {version} on {here.system} {here.machine}"
    )
    raise error.with_hint(". ".join([*refused, advice(here)]))


def _load() -> tuple[ctypes.CDLL, ctypes.PyDLL]:
    try:
        return ctypes.CDLL(LIBRARY.path), ctypes.PyDLL(LIBRARY.path)
    except OSError as reason:
        error = WireError(f"{LIBRARY} cannot be loaded: {reason}")
        raise error.with_hint(
            "Set CYCLONEDDS_HOME to the prefix of another library, or use Zenoh with "
            "RMW_IMPLEMENTATION=rmw_zenoh_cpp."
        ) from reason


#: The library of this process, and its binary interface.
LIBRARY, ABI = _find()
_waiting_library, _short_library = _load()


def _declare(
    library: ctypes.CDLL, name: str, result: Any, arguments: tuple[Any, ...]
) -> Callable[..., Any]:
    try:
        function: Any = getattr(library, name)
    except AttributeError as error:
        raise WireError(
            f"{LIBRARY} has no {name}, which versions {ABI.version} have elsewhere"
        ) from error
    function.restype = result
    function.argtypes = arguments
    return function  # type: ignore[no-any-return]


def _waits(name: str, result: Any, *arguments: Any) -> Callable[..., Any]:
    return _declare(_waiting_library, name, result, arguments)


def _short(name: str, result: Any, *arguments: Any) -> Callable[..., Any]:
    return _declare(_short_library, name, result, arguments)


class IoVec(ctypes.Structure):
    """One block of memory; the operating system fixes the order of the fields."""

    _fields_ = (
        [("size", c_uint32), ("base", c_char_p)]  # WSABUF
        if sys.platform == "win32"
        else [("base", c_char_p), ("size", c_size_t)]
    )


class SampleInfo(ctypes.Structure):
    """dds_sample_info_t."""

    _fields_ = [
        ("sample_state", c_uint32),
        ("view_state", c_uint32),
        ("instance_state", c_uint32),
        ("valid_data", c_bool),
        ("source_timestamp", c_int64),
        ("instance_handle", c_uint64),
        ("publication_handle", c_uint64),
        ("disposed_generation_count", c_uint32),
        ("no_writers_generation_count", c_uint32),
        ("sample_rank", c_uint32),
        ("generation_rank", c_uint32),
        ("absolute_generation_rank", c_uint32),
    ]


class _TypeMetaData(ctypes.Structure):
    _fields_ = [("data", c_void_p), ("size", c_uint32)]


class TopicDescriptor(ctypes.Structure):
    """dds_topic_descriptor_t."""

    _fields_ = [
        ("size", c_uint32),
        ("align", c_uint32),
        ("flags", c_uint32),
        ("key_count", c_uint32),
        ("type_name", c_char_p),
        ("keys", c_void_p),
        ("op_count", c_uint32),
        ("ops", c_void_p),
        ("meta", c_char_p),
        ("type_information", _TypeMetaData),
        ("type_mapping", _TypeMetaData),
        ("restrict_data_representation", c_uint32),
    ]


class Guid(ctypes.Structure):
    """dds_guid_t: 12 bytes of the participant, 4 of the entity."""

    _fields_ = [("bytes", c_uint8 * 16)]


class BuiltinParticipant(ctypes.Structure):
    """dds_builtintopic_participant_t."""

    _fields_ = [("key", Guid), ("qos", c_void_p)]


class BuiltinEndpoint(ctypes.Structure):
    """dds_builtintopic_endpoint_t."""

    _fields_ = [
        ("key", Guid),
        ("participant_key", Guid),
        ("participant_instance_handle", c_uint64),
        ("topic_name", c_char_p),
        ("type_name", c_char_p),
        ("qos", c_void_p),
    ]


class CountStatus(ctypes.Structure):
    """The beginning of all statuses that count; deadline missed has an instance handle behind."""

    _fields_ = [
        ("total_count", c_uint32),
        ("total_count_change", c_int32),
        ("last_handle", c_uint64),
    ]


class IncompatibleStatus(ctypes.Structure):
    """dds_offered_incompatible_qos_status_t and dds_requested_incompatible_qos_status_t."""

    _fields_ = [
        ("total_count", c_uint32),
        ("total_count_change", c_int32),
        ("last_policy_id", c_uint32),
    ]


class LivelinessChangedStatus(ctypes.Structure):
    """dds_liveliness_changed_status_t."""

    _fields_ = [
        ("alive_count", c_uint32),
        ("not_alive_count", c_uint32),
        ("alive_count_change", c_int32),
        ("not_alive_count_change", c_int32),
        ("last_handle", c_uint64),
    ]


class MatchedStatus(ctypes.Structure):
    """dds_publication_matched_status_t and dds_subscription_matched_status_t."""

    _fields_ = [
        ("total_count", c_uint32),
        ("total_count_change", c_int32),
        ("current_count", c_uint32),
        ("current_count_change", c_int32),
        ("last_handle", c_uint64),
    ]


_entity = c_int32
_retcode = c_int32
_handle = c_uint64

create_domain = _waits("dds_create_domain", _entity, c_uint32, c_char_p)
create_participant = _waits("dds_create_participant", _entity, c_uint32, c_void_p, c_void_p)
create_topic = _waits(
    "dds_create_topic", _entity, _entity, POINTER(TopicDescriptor), c_char_p, c_void_p, c_void_p
)
create_writer = _waits("dds_create_writer", _entity, _entity, _entity, c_void_p, c_void_p)
create_reader = _waits("dds_create_reader", _entity, _entity, _entity, c_void_p, c_void_p)
create_read_condition = _waits("dds_create_readcondition", _entity, _entity, c_uint32)
create_guard_condition = _waits("dds_create_guardcondition", _entity, _entity)
create_wait_set = _waits("dds_create_waitset", _entity, _entity)
delete = _waits("dds_delete", _retcode, _entity)
wait_for_acks = _waits("dds_wait_for_acks", _retcode, _entity, c_int64)
create_topic_of_type = _waits(
    "dds_create_topic_sertype",
    *(_entity, _entity, c_char_p, POINTER(c_void_p), c_void_p, c_void_p, c_void_p),
)

set_guard_condition = _short("dds_set_guardcondition", _retcode, _entity, c_bool)
wait_set_attach = _waits("dds_waitset_attach", _retcode, _entity, _entity, c_int64)
wait_set_detach = _waits("dds_waitset_detach", _retcode, _entity, _entity)
wait_set_wait = _waits("dds_waitset_wait", _retcode, _entity, POINTER(c_int64), c_size_t, c_int64)

create_listener = _short("dds_create_listener", c_void_p, c_void_p)
delete_listener = _short("dds_delete_listener", None, c_void_p)
lset_data_available = _short("dds_lset_data_available", None, c_void_p, c_void_p)
lset_subscription_matched = _short(
    "dds_lset_subscription_matched_arg", _retcode, c_void_p, c_void_p, c_void_p, c_bool
)
set_listener = _waits("dds_set_listener", _retcode, _entity, c_void_p)

set_status_mask = _short("dds_set_status_mask", _retcode, _entity, c_uint32)
get_status_changes = _short("dds_get_status_changes", _retcode, _entity, POINTER(c_uint32))
publication_matched_status = _short(
    "dds_get_publication_matched_status", _retcode, _entity, POINTER(MatchedStatus)
)
subscription_matched_status = _short(
    "dds_get_subscription_matched_status", _retcode, _entity, POINTER(MatchedStatus)
)
offered_incompatible_status = _short(
    "dds_get_offered_incompatible_qos_status", _retcode, _entity, POINTER(IncompatibleStatus)
)
requested_incompatible_status = _short(
    "dds_get_requested_incompatible_qos_status", _retcode, _entity, POINTER(IncompatibleStatus)
)
offered_deadline_status = _short(
    "dds_get_offered_deadline_missed_status", _retcode, _entity, POINTER(CountStatus)
)
requested_deadline_status = _short(
    "dds_get_requested_deadline_missed_status", _retcode, _entity, POINTER(CountStatus)
)
liveliness_lost_status = _short(
    "dds_get_liveliness_lost_status", _retcode, _entity, POINTER(CountStatus)
)
liveliness_changed_status = _short(
    "dds_get_liveliness_changed_status", _retcode, _entity, POINTER(LivelinessChangedStatus)
)
sample_lost_status = _short("dds_get_sample_lost_status", _retcode, _entity, POINTER(CountStatus))
assert_liveliness = _waits("dds_assert_liveliness", _retcode, _entity)

get_guid = _short("dds_get_guid", _retcode, _entity, POINTER(Guid))
get_instance_handle = _short("dds_get_instance_handle", _retcode, _entity, POINTER(c_uint64))
if ABI.tells_type:
    get_sertype = _short("dds_get_entity_sertype", _retcode, _entity, POINTER(c_void_p))
else:
    get_topic = _short("dds_get_topic", _entity, _entity)
    pin_entity = _short("dds_entity_pin", _retcode, _entity, POINTER(c_void_p))
    unpin_entity = _short("dds_entity_unpin", None, c_void_p)
    default_types = c_char.in_dll(_short_library, "ddsi_sertype_ops_default")
hold_sertype = _short("ddsi_sertype_ref", c_void_p, c_void_p)
release_sertype = _short("ddsi_sertype_unref", None, c_void_p)
return_code_text = _short("dds_strretcode", c_char_p, c_int32)
free = _short("dds_free", None, c_void_p)

_iovec_count = {"linux": c_size_t, "darwin": c_int}.get(sys.platform, c_uint32)
serdata_from_bytes = _short(
    "ddsi_serdata_from_ser_iov", c_void_p, c_void_p, c_int, _iovec_count, POINTER(IoVec), c_size_t
)
serdata_to_bytes = _short("ddsi_serdata_to_ser", None, c_void_p, c_size_t, c_size_t, c_char_p)
serdata_size = _short("ddsi_serdata_size", c_uint32, c_void_p)
serdata_unref = _short("ddsi_serdata_unref", None, c_void_p)
write_serdata = _waits("dds_writecdr", _retcode, _entity, c_void_p)
take_serdata = _short(
    "dds_takecdr", _retcode, _entity, POINTER(c_void_p), c_uint32, POINTER(SampleInfo), c_uint32
)

take_samples = _short(
    "dds_take", _retcode, _entity, POINTER(c_void_p), POINTER(SampleInfo), c_size_t, c_uint32
)
return_loan = _short("dds_return_loan", _retcode, _entity, POINTER(c_void_p), c_int32)

matched_subscriptions = _short(
    "dds_get_matched_subscriptions", _retcode, _entity, POINTER(_handle), c_size_t
)
matched_publications = _short(
    "dds_get_matched_publications", _retcode, _entity, POINTER(_handle), c_size_t
)
matched_subscription_data = _short(
    "dds_get_matched_subscription_data", POINTER(BuiltinEndpoint), _entity, _handle
)
matched_publication_data = _short(
    "dds_get_matched_publication_data", POINTER(BuiltinEndpoint), _entity, _handle
)
free_endpoint = _short("dds_builtintopic_free_endpoint", None, POINTER(BuiltinEndpoint))

create_qos = _short("dds_create_qos", c_void_p)
delete_qos = _short("dds_delete_qos", None, c_void_p)
qset_reliability = _short("dds_qset_reliability", None, c_void_p, c_int, c_int64)
qset_history = _short("dds_qset_history", None, c_void_p, c_int, c_int32)
qset_durability = _short("dds_qset_durability", None, c_void_p, c_int)
qset_durability_service = _short(
    "dds_qset_durability_service",
    None,
    c_void_p,
    c_int64,
    c_int,
    c_int32,
    c_int32,
    c_int32,
    c_int32,
)
qset_deadline = _short("dds_qset_deadline", None, c_void_p, c_int64)
qset_lifespan = _short("dds_qset_lifespan", None, c_void_p, c_int64)
qset_liveliness = _short("dds_qset_liveliness", None, c_void_p, c_int, c_int64)
qset_user_data = _short("dds_qset_userdata", None, c_void_p, c_char_p, c_size_t)
qset_partition = _short("dds_qset_partition", None, c_void_p, c_uint32, POINTER(c_char_p))
qset_ignore_local = _short("dds_qset_ignorelocal", None, c_void_p, c_int)
qset_writer_data_lifecycle = _short("dds_qset_writer_data_lifecycle", None, c_void_p, c_bool)

qget_reliability = _short(
    "dds_qget_reliability", c_bool, c_void_p, POINTER(c_int), POINTER(c_int64)
)
qget_history = _short("dds_qget_history", c_bool, c_void_p, POINTER(c_int), POINTER(c_int32))
qget_durability = _short("dds_qget_durability", c_bool, c_void_p, POINTER(c_int))
qget_deadline = _short("dds_qget_deadline", c_bool, c_void_p, POINTER(c_int64))
qget_lifespan = _short("dds_qget_lifespan", c_bool, c_void_p, POINTER(c_int64))
qget_liveliness = _short("dds_qget_liveliness", c_bool, c_void_p, POINTER(c_int), POINTER(c_int64))
qget_user_data = _short("dds_qget_userdata", c_bool, c_void_p, POINTER(c_void_p), POINTER(c_size_t))


def duration(timeout_ns: int | None) -> int:
    """Limit a timeout to the range of DDS: from 0 to its infinite duration."""
    return INFINITE_NS if timeout_ns is None else min(max(timeout_ns, 0), INFINITE_NS)


def check(code: int, what: str) -> int:
    """Return ``code`` (an entity or a count), or raise when it is an error.

    Raises:
        WireError: ``what`` and Cyclone's reason.
    """
    if code < 0:
        raise WireError(f"{what}: Cyclone DDS says {return_code_text(code).decode()}")
    return code


def guid_of(entity: int) -> bytes:
    """Return the 16 bytes that identify a participant, writer or reader."""
    guid = Guid()
    check(get_guid(entity, guid), "read a guid")
    return bytes(guid)
