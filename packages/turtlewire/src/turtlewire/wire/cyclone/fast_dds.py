"""Services with Fast DDS, the default middleware of ROS 2.

rmw_cyclonedds writes the identity of a request in front of its fields. Fast DDS sends it in the
inline QoS of the sample, which Cyclone's API does not show. Native code reads and writes it inside
Cyclone. It depends on the layout of some internal structures, so it accepts known versions only and
checks each structure before it changes anything.

`FirstRequests` recovers the request that a client sends before the server has discovered it.
"""

from __future__ import annotations

import contextlib
import os
import socket
import sys
import threading
from collections.abc import Iterator
from struct import Struct
from typing import TYPE_CHECKING

from turtlewire.wire.base import RequestId
from turtlewire.wire.environment import asks_for_security
from turtlewire.wire.loopback import ports_of_sockets
from turtlewire.wire.report import warn_once

from . import library as dds
from .native import NATIVE, address_of
from .ports import unicast_ports_of
from .samples import sertype_of

if TYPE_CHECKING:
    from .endpoint import Endpoint, EndpointSpec
    from .participant import Participant

_VERSIONS = ("11.0", "0.10")
_ENCAPSULATION = 4
_MARK = b"\xfaFastDDS"
_HEADER = Struct("<8s16sq")
_BODY = _ENCAPSULATION + _HEADER.size
_GUID_SIZE = 16
#: Numbers of clients of rmw_cyclonedds are below; a GUID ends with a byte that is not 0.
_FIRST_GUID = 1 << 64


def split_identity(payload: bytes) -> tuple[RequestId, bytes] | None:
    """Split a message into its identity and the rest; None if it has no identity.

    The identity's client number is a GUID; `guid_of_client` returns its bytes.
    """
    if not payload.startswith(_MARK, _ENCAPSULATION) or len(payload) < _BODY:
        return None
    _, guid, number = _HEADER.unpack_from(payload, _ENCAPSULATION)
    request_id = RequestId(int.from_bytes(guid, "little"), number)
    return request_id, payload[:_ENCAPSULATION] + payload[_BODY:]


def guid_of_client(client_id: int) -> bytes:
    """Return the GUID of a client on Fast DDS; empty for a client on rmw_cyclonedds."""
    return client_id.to_bytes(_GUID_SIZE, "little") if client_id >= _FIRST_GUID else b""


def _find_obstacle() -> str:
    if NATIVE is None:
        return "they need the compiled core"
    if sys.platform != "linux":
        return "they need Linux"
    if dds.ABI.version not in _VERSIONS:
        return f"they do not work with {dds.LIBRARY}"
    if asks_for_security(os.environ):
        return "ROS_SECURITY_ENABLE is true"
    return ""


class _SharedType:
    """A type whose functions were exchanged, for all endpoints of its name in a domain.

    To Cyclone, each such type is a new one with the hash of its name, and its table of types holds
    at most 32 of one hash: beyond, it would grow without end.
    """

    def __init__(self, key: tuple[int, str], sertype: int) -> None:
        self.key = key
        self.sertype = sertype
        self.users = 0


class FastDds:
    """The state of services with Fast DDS in this process. Thread-safe.

    Attributes:
        obstacle: The reason why they do not work; empty if they work.
    """

    def __init__(self, obstacle: str) -> None:
        self.obstacle = obstacle
        self._lock = threading.Lock()
        self._types: dict[tuple[int, str], _SharedType] = {}

    @contextlib.contextmanager
    def shared_type(self, participant: Participant, endpoint: Endpoint) -> Iterator[int]:
        """The address of the type to make a new endpoint with, which Cyclone releases.

        It is 0 if the endpoint is not one of a service, or if its type cannot carry identities.
        """
        shared = self._join(participant, endpoint.spec)
        if shared is None:
            yield 0
            return
        try:
            yield dds.hold_sertype(shared.sertype)
        except BaseException:
            self._leave(shared)
            raise
        endpoint.shared_type = shared.sertype
        endpoint.on_closing.append(lambda: self._leave(shared))

    def _join(self, participant: Participant, spec: EndpointSpec) -> _SharedType | None:
        if self.obstacle or not spec.carries_identities:
            return None
        key = participant.domain_id, spec.type_id.name
        with self._lock:
            if key not in self._types:
                with participant.topic(spec.dds_topic, spec.type_id.name) as topic:
                    sertype = sertype_of(topic)
                    if not _exchange(sertype):
                        self.give_up("types")
                        return None
                    self._types[key] = _SharedType(key, dds.hold_sertype(sertype))
            shared = self._types[key]
            shared.users += 1
            return shared

    def _leave(self, shared: _SharedType) -> None:
        with self._lock:
            shared.users -= 1
            if shared.users:
                return
            del self._types[shared.key]
        dds.release_sertype(shared.sertype)

    def prepare(self, endpoint: Endpoint) -> bool:
        """Make a reader or writer of a service carry identities.

        Returns:
            False if that is not possible.
        """
        if self.obstacle or not endpoint.shared_type:
            return False
        if not _exchange(sertype_of(endpoint.handle), endpoint.shared_type):
            self.give_up("types")
            return False
        return True

    def give_up(self, what: str) -> None:
        """Turn services with Fast DDS off, because Cyclone's ``what`` have another layout."""
        self.obstacle = f"{dds.LIBRARY} has an unexpected layout of {what}"
        self.say_obstacle()

    def say_obstacle(self) -> None:
        """Warn once that services with Fast DDS do not work, with the reason."""
        warn_once("services with Fast DDS", f"no services with Fast DDS here: {self.obstacle}")


def _exchange(sertype: int, shared: int = 0) -> bool:
    """Have messages of a type carry identities; False if that is not possible.

    Args:
        sertype: Address of the type.
        shared: Address of the type that its endpoint was made with. Cyclone 11 makes a copy of it
            for each writer. 0 if this type is to be shared.
    """
    assert NATIVE is not None
    from turtlewire._native import carry_identities, keep_type

    keeps = bool(shared) or dds.ABI.tells_type or keep_type(NATIVE, sertype)
    return keeps and carry_identities(NATIVE, sertype, 0 if shared == sertype else shared)


FAST_DDS = FastDds(_find_obstacle())

_ELSEWHERE = ("192.0.2.1", 9)  # an address of no computer (RFC 5737)
_KEEP_STATUS = False  # else the reader thread would not see that something has matched


class FirstRequests:
    """Asks each new client of a service on Fast DDS for what it sent before it was discovered.

    A client sends its first request as soon as it has found the server, which may not have found
    the client yet. Cyclone drops that request, and reads a volatile writer only from the sample
    after those that its first heartbeat lists. The first heartbeat of a new client lists this
    request. (A client on Cyclone waits for that heartbeat before it sends anything.)

    So the server sends itself two heartbeats in the name of the new client before the client's own:
    the first lists no sample, the second lists one, which Cyclone then requests. Fast DDS sends it
    again if it exists and was meant for this server; otherwise it sends nothing. Native code sends
    the heartbeats, because it does not wait for the GIL: the client's own heartbeat arrives within
    milliseconds.

    Native code uses this object until `close`, so it must be kept until then.

    Args:
        handle: The reader of requests.
        reader: Its GUID.
        targets: What `receiving_addresses` returns.
    """

    def __init__(self, handle: int, reader: bytes, targets: list[tuple[int, int]]) -> None:
        from turtlewire._native import CycloneFirstRequests

        functions = [address_of(dds.matched_publication_data), address_of(dds.free_endpoint)]
        self._handle = handle
        self._native = CycloneFirstRequests(functions, reader, targets)
        callback, argument = self._native.listener()
        listener = dds.create_listener(None)
        dds.lset_subscription_matched(listener, callback, argument, _KEEP_STATUS)
        dds.check(dds.set_listener(handle, listener), "listen for clients")
        dds.delete_listener(listener)

    def close(self) -> None:
        """Ask no more clients; wait for the end of a call of native code."""
        dds.set_listener(self._handle, None)
        self._native.close()


def receiving_addresses(domain_id: int) -> list[tuple[int, int]]:
    """Return the IPv4 addresses, as numbers, and ports at which this process receives.

    It looks at all open files, so call it once for each context.
    """
    ports = ports_of_sockets(unicast_ports_of(domain_id))
    return [(address, port) for port in ports for address in _own_addresses()]


def _own_addresses() -> set[int]:
    """Return the loopback address, and the one from which other computers are reached."""
    found = {"127.0.0.1"}
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as route:
        try:
            route.connect(_ELSEWHERE)  # sends nothing
            found.add(route.getsockname()[0])
        except OSError:  # this computer has no other address
            pass
    return {int.from_bytes(socket.inet_aton(address), "big") for address in found}
