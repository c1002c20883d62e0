"""Checks the options, types and messages of a new bag; errors name the reason."""

from __future__ import annotations

import re
import warnings
from typing import Any

from turtlewire.bag.compression import compress, most_bytes
from turtlewire.bag.definitions import ENCODING, definition_text
from turtlewire.bag.metadata import NEWEST_VERSION, full_type_name
from turtlewire.errors import BagError, InterfaceError
from turtlewire.msg import Message, serialize

__all__ = [
    "ENDINGS",
    "as_cdr",
    "check_name",
    "check_options",
    "check_sizes",
    "checked_type_name",
    "compressed_message",
    "given",
    "known_definition",
]

#: What the names of files end with, by storage.
ENDINGS = {"mcap": "mcap", "sqlite3": "db3"}

_MODES = ("", "FILE", "MESSAGE")
_TYPE_NAME = re.compile(r"\w+/\w+/\w+")


def check_name(name: str) -> None:
    """Refuse a name whose bytes are not UTF-8: metadata.yaml, which is UTF-8, contains it.

    Raises:
        BagError: With what to do.
    """
    try:
        name.encode()
    except UnicodeEncodeError:
        raise BagError(f"the name {name!r} is not UTF-8").with_hint(
            "Choose another name, because metadata.yaml contains it."
        ) from None


def check_options(
    storage: str, compression: str, level: int, compression_mode: str, metadata_version: int
) -> None:
    """Refuse a combination that no bag has; see `BagWriter` for the arguments.

    Raises:
        BagError: With what there is instead.
    """
    if storage not in ENDINGS:
        raise BagError(f"unknown storage '{storage}'").with_hint("Use 'mcap' or 'sqlite3'.")
    if compression_mode not in _MODES:
        raise BagError(f"unknown compression mode '{compression_mode}'").with_hint(
            "Use 'FILE', 'MESSAGE' or ''."
        )
    compress(compression, b"", level)  # refuse one that is not known or not installed
    if compression_mode == "MESSAGE" and storage == "mcap":
        raise BagError("MCAP files compress chunks, not messages").with_hint(
            "Give compression='zstd' instead."
        )
    if compression and storage == "sqlite3":
        raise BagError(f"sqlite3 files have no chunks to compress with {compression}").with_hint(
            "Give compression_mode='MESSAGE' or 'FILE' instead."
        )
    if metadata_version not in range(1, NEWEST_VERSION + 1):
        raise BagError(f"unknown version {metadata_version} of the metadata").with_hint(
            f"Use 1 to {NEWEST_VERSION}."
        )


def check_sizes(chunk_bytes: int, max_file_bytes: int, max_file_ns: int, max_files: int) -> None:
    """Refuse sizes, times and numbers that none can have.

    Raises:
        BagError: With the least that can be given.
    """
    for name, value, least in (
        ("chunk_bytes", chunk_bytes, 1),
        ("max_file_bytes", max_file_bytes, 0),
        ("max_file_ns", max_file_ns, 0),
        ("max_files", max_files, 0),
    ):
        if value < least:
            raise BagError(f"{name} is {value}, and must be at least {least}")


def checked_type_name(name: str) -> str:
    """Return the full name of a type, which may have two parts.

    Raises:
        TypeError: ``name`` is not a str.
    """
    if not isinstance(name, str):
        advice = f"; write {name._TYPE_NAME!r}" if hasattr(name, "_TYPE_NAME") else ""
        raise TypeError(f"the name of a type must be str, not {type(name).__name__}{advice}")
    return full_type_name(name)


def known_definition(type_name: str) -> tuple[str, str]:
    """Encoding and text of a type's definition; of an unknown one none, with a warning.

    Raises:
        BagError: ``type_name`` is not the name of a type.
    """
    if not _TYPE_NAME.fullmatch(type_name):
        raise BagError(f"'{type_name}' is not the name of a message type").with_hint(
            "Names of types look like std_msgs/msg/String."
        )
    try:
        return ENCODING, definition_text(type_name)
    except InterfaceError as error:
        warnings.warn(
            f"the bag has no definition of {type_name}, so readers need one: {error}",
            stacklevel=3,
        )
        return "unknown", ""  # what rosbag2 writes for a definition that it does not find


def as_cdr(topic: str, type_name: str, data: Any) -> bytes:
    """Return the bytes of a message for a topic.

    Raises:
        TypeError: ``data`` is a message of another type, or neither a message nor bytes.
        BagError: ``data`` is empty.
    """
    if isinstance(data, Message):
        if type_name != data._TYPE_NAME:
            raise TypeError(f"{topic} holds {type_name}, not {data._TYPE_NAME}")
        return serialize(data)
    try:
        packed = bytes(_byte_view(data))
    except TypeError:
        raise TypeError(
            f"{topic} accepts a {type_name} or its CDR bytes, not {given(data, topic)}"
        ) from None
    if not packed:
        raise BagError(f"{topic} accepts a {type_name} or its CDR bytes, not 0 bytes").with_hint(
            "turtlewire.msg.serialize() makes the bytes of a message."
        )
    return packed


def _byte_view(data: Any) -> memoryview:
    view = memoryview(data)
    if view.format not in ("B", "b", "c"):
        raise TypeError("numbers are not the bytes of a message")
    return view


def given(data: Any, topic: str) -> str:
    """Return what was passed in place of a message, and what to write for it."""
    if isinstance(data, type):
        return f"the class {data.__name__}; write {data.__name__}() for a message"
    name, advice = type(data).__name__, ""
    if topic in ("/tf", "/tf_static"):
        advice = "; put TransformStamped messages into TFMessage(transforms=[...])"
    elif isinstance(data, dict):
        advice = "; fields are given to the class of the message: msg.get_message(type)(**fields)"
    return name + advice


def compressed_message(topic: str, data: bytes) -> bytes:
    """Compress a message with zstd.

    Raises:
        BagError: Readers would refuse the message.
    """
    packed = compress("zstd", data)
    limit = most_bytes(len(packed))
    if len(data) > limit:
        raise BagError(
            f"a message of {topic} has {len(data)} bytes, and readers accept at most {limit} for "
            f"{len(packed)} compressed bytes"
        ).with_hint("Write it without compression_mode='MESSAGE'.")
    return packed
