"""The frames of Foxglove's WebSocket protocol, version 1.

Text frames are JSON objects with an ``op``; binary ones begin with an operation code and are little
endian. Nothing here knows a connection.
"""

from __future__ import annotations

import json
from struct import Struct
from typing import Any, NamedTuple

from turtlewire.wording import counted

__all__ = [
    "CAPABILITIES",
    "ENCODINGS",
    "ERROR",
    "SUBPROTOCOLS",
    "WARNING",
    "ClientMessage",
    "ProtocolError",
    "ServiceRequest",
    "asset",
    "asset_error",
    "integer",
    "items",
    "message_data",
    "names",
    "parse_binary",
    "parse_text",
    "required_text",
    "service_response",
    "status",
    "text",
    "text_or_none",
    "time_data",
]

_KINDS = {dict: "objects", int: "numbers", str: "strings"}


def items(request: dict[str, Any], field: str, kind: type = dict) -> list[Any]:
    """Return a list of objects, numbers or strings.

    Raises:
        ProtocolError: The field is not such a list.
    """
    value = request.get(field)
    if not isinstance(value, list) or not all(type(item) is kind for item in value):
        raise ProtocolError(f'"{field}" must be a list of {_KINDS[kind]}')
    return value


def names(request: dict[str, Any]) -> list[str]:
    """Return the names of parameters; a missing field means none.

    Raises:
        ProtocolError: The field is not a list of strings.
    """
    return items({"parameterNames": [], **request}, "parameterNames", str)


def integer(item: dict[str, Any], field: str) -> int:
    """Return a number that fits into 32 bits without a sign.

    Raises:
        ProtocolError: The field is not such a number.
    """
    value = item.get(field)
    if type(value) is not int or not 0 <= value < 1 << 32:
        raise ProtocolError(f'"{field}" must be an integer from 0 to 4294967295')
    return value


def required_text(item: dict[str, Any], field: str) -> str:
    """Return a string.

    Raises:
        ProtocolError: The field is missing or not a string.
    """
    value = text_or_none(item, field)
    if value is None:
        raise ProtocolError(f'"{field}" is missing')
    return value


def text_or_none(item: dict[str, Any], field: str) -> str | None:
    """Return a string, or None if there is no such field.

    Raises:
        ProtocolError: The field is something else.
    """
    value = item.get(field)
    if value is not None and not isinstance(value, str):
        raise ProtocolError(f'"{field}" must be a string')
    return value


#: Two names of one protocol.
SUBPROTOCOLS = ("foxglove.sdk.v1", "foxglove.websocket.v1")
#: What a server may offer; ``time`` only with simulated time.
CAPABILITIES = (
    "clientPublish",
    "parameters",
    "parametersSubscribe",
    "services",
    "connectionGraph",
    "assets",
    "time",
)
#: How clients may encode what they publish, and requests of services.
ENCODINGS = ("cdr", "json")

#: Levels of a status.
WARNING, ERROR = 1, 2

_MESSAGE_DATA = Struct("<BIQ")
_TIME = Struct("<BQ")
_SERVICE = Struct("<BIII")
_ASSET = Struct("<BIBI")
_CLIENT_MESSAGE = Struct("<BI")
#: Longest text frame of a client [characters]; parsing one blocks all others.
_LONGEST_TEXT = 1 << 20


class ProtocolError(ValueError):
    """A client's frame is not of this protocol; the text says what is wrong."""


class ClientMessage(NamedTuple):
    """A message that a client publishes on one of its channels."""

    channel_id: int
    payload: bytes


class ServiceRequest(NamedTuple):
    """A call of a service."""

    service_id: int
    call_id: int
    encoding: str
    payload: bytes


def text(op: str, **fields: Any) -> str:
    """Return a text frame; fields that are None are left out."""
    return json.dumps(
        {"op": op, **{name: value for name, value in fields.items() if value is not None}},
        separators=(",", ":"),
        allow_nan=False,
    )


def status(level: int, message: str) -> str:
    """Return a line for the client's user."""
    return text("status", level=level, message=message)


def message_data(subscription_id: int, time_ns: int, cdr: bytes) -> bytes:
    """Return a message of a subscription, with the time at which it was received."""
    return _MESSAGE_DATA.pack(1, subscription_id, time_ns) + cdr


def time_data(time_ns: int) -> bytes:
    """Return the time of the simulation."""
    return _TIME.pack(2, time_ns)


def service_response(service_id: int, call_id: int, encoding: str, payload: bytes) -> bytes:
    """Return the response of a service."""
    encoded = encoding.encode(errors="replace")
    return _SERVICE.pack(3, service_id, call_id, len(encoded)) + encoded + payload


def asset(request_id: int, data: bytes) -> bytes:
    """Return a file that a client asked for."""
    return _ASSET.pack(4, request_id, 0, 0) + data


def asset_error(request_id: int, message: str) -> bytes:
    """Return the answer that explains why a client does not get a file."""
    encoded = message.encode(errors="replace")
    return _ASSET.pack(4, request_id, 1, len(encoded)) + encoded


def parse_text(frame: str) -> dict[str, Any]:
    """Return the object of a client's text frame; its ``op`` is a string.

    Raises:
        ProtocolError: The frame is no such object, or too long.
    """
    if len(frame) > _LONGEST_TEXT:
        raise ProtocolError(
            f"a text frame of {len(frame)} characters is too long (at most {_LONGEST_TEXT})"
        )
    try:
        parsed = json.loads(frame)
    except (ValueError, RecursionError) as error:
        raise ProtocolError(f"a text frame is not JSON: {error}") from error
    if not isinstance(parsed, dict) or not isinstance(parsed.get("op"), str):
        raise ProtocolError('a text frame is a JSON object with a string "op"')
    return parsed


def parse_binary(frame: bytes) -> ClientMessage | ServiceRequest:
    """Parse a client's binary frame.

    Raises:
        ProtocolError: The frame is unknown or ends too early.
    """
    if not frame:
        raise ProtocolError("a binary frame is empty")
    if frame[0] == 1 and len(frame) >= _CLIENT_MESSAGE.size:
        return ClientMessage(_CLIENT_MESSAGE.unpack_from(frame)[1], frame[_CLIENT_MESSAGE.size :])
    if frame[0] == 2 and len(frame) >= _SERVICE.size:
        _, service_id, call_id, length = _SERVICE.unpack_from(frame)
        end = _SERVICE.size + length
        if end <= len(frame):
            encoding = frame[_SERVICE.size : end].decode("utf-8", "replace")
            return ServiceRequest(service_id, call_id, encoding, frame[end:])
    if frame[0] in {1, 2}:
        size = counted(len(frame), "byte")
        raise ProtocolError(f"a binary frame of operation {frame[0]} ends after {size}, too early")
    raise ProtocolError(f"there is no binary operation {frame[0]}; clients send 1 and 2")
