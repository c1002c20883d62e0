"""The Python values of fields.

Defaults, conversion at assignment, and the letter or dtype of its storage.

As in ROS 2, sequences of numbers are ``array.array``, fixed arrays of numbers are NumPy arrays,
everything else repeated is a list. A fixed array that was received, or that the constructor filled,
stays in its slot as the bytes of the wire (little endian) until a program looks at it: importing
NumPy takes longer than a node needs to start, and few programs look at covariances and UUIDs.

ROS 2 holds a ``wstring`` as UTF-16; on Linux, its typesupport for Cyclone DDS and Fast DDS widens
each code unit to a ``wchar_t`` of four bytes. So a character beyond the basic plane takes two
units, eight bytes.
"""

from __future__ import annotations

import sys
from array import array
from collections.abc import Callable, Iterable
from contextlib import suppress
from typing import TYPE_CHECKING, Any, Union

from turtlewire.msg.types import (
    FLOATING_POINT_TYPES,
    TYPE_CODES,
    AbstractGenericString,
    AbstractNestedType,
    AbstractSequence,
    Array,
    BasicType,
)

if TYPE_CHECKING:
    from typing_extensions import Buffer

    from turtlewire.msg.types import AbstractType

Cdr = Union[bytes, bytearray, "tuple[Buffer, ...]"]
"""An encoded message: its bytes, or the buffers that make it up one after the other.

The buffers may be those of the message's own sequences, so they must be used at once."""

#: Letters of one kind: NumPy's 64-bit integers have l and L where array.array has q and Q.
_LETTERS = ("bhilq", "BHILQ", "f", "d")
_NUMPY_NAMES = {"float": "float32", "double": "float64"}


def element_code(type_: AbstractType) -> str:
    """``array.array`` letter of a sequence or array of numbers; empty for every other type."""
    if isinstance(type_, AbstractNestedType) and isinstance(type_.value_type, BasicType):
        return TYPE_CODES.get(type_.value_type.typename, "")
    return ""


def numpy_name(typename: str) -> str:
    """NumPy's name of a numeric type: ``float64`` for ``double``."""
    return _NUMPY_NAMES.get(typename, typename)


def raw_name(name: str) -> str:
    """Attribute that is the slot itself of a field whose assignment converts the value."""
    return f"_raw_{name}"


def scalar_default(type_: AbstractType) -> Any:
    """Default of a number, bool, byte or string that gives none itself.

    None for nested messages.
    """
    if isinstance(type_, BasicType):
        if type_.typename == "boolean":
            return False
        if type_.typename == "octet":
            return b"\x00"
        return 0.0 if type_.typename in FLOATING_POINT_TYPES else 0
    return "" if isinstance(type_, AbstractGenericString) else None


def converter(type_: AbstractType) -> Callable[[Any], Any] | None:
    """Return the converter of assigned values for a numeric sequence or array.

    None where values are stored as given.
    """
    code = element_code(type_)
    if not code:
        return None
    if isinstance(type_, AbstractSequence):
        return lambda value: to_array(code, value)
    assert isinstance(type_, Array)
    assert isinstance(type_.value_type, BasicType)
    dtype = numpy_name(type_.value_type.typename)
    return lambda value: to_numpy(dtype, value)


def to_array(code: str, value: Iterable[Any]) -> array[Any]:
    """Make an ``array.array`` of numbers.

    One of the right letter is kept, buffers (any shape, row by row) are copied whole.
    """
    if type(value) is array and value.typecode == code:
        return value  # not copied, as in ROS 2
    if isinstance(value, (list, tuple)):
        return array(code, value)
    view = None
    with suppress(TypeError):
        view = memoryview(value)  # type: ignore[arg-type]
    if view is None:
        return array(code, value)
    result = array(code)
    same_kind = any(code in letters and view.format in letters for letters in _LETTERS)
    if same_kind and view.itemsize == result.itemsize:
        result.frombytes(view.cast("B") if view.c_contiguous else view.tobytes())
    else:
        result.extend(value.ravel().tolist() if hasattr(value, "ravel") else view.tolist())
    return result


def array_values(code: str, values: Iterable[Any]) -> bytes:
    """Return the bytes of a fixed array from its values."""
    content = array(code, values)
    if sys.byteorder == "big":
        content.byteswap()
    return content.tobytes()


def array_of_bytes(dtype: str, content: bytes) -> Any:
    """Return the NumPy array of a fixed array from its bytes; it shares no memory with them."""
    import numpy as np

    return np.frombuffer(content, np.dtype(dtype).newbyteorder("<")).astype(dtype)


def array_content(message: object, name: str) -> bytes:
    """The bytes of a fixed array of numbers, little endian, without NumPy where it can be."""
    value = getattr(message, raw_name(name))
    if type(value) is bytes:
        return value
    content: bytes = value.astype(value.dtype.newbyteorder("<"), copy=False).tobytes()
    return content


def to_numpy(dtype: str, value: Any) -> Any:
    """Make a NumPy array of a fixed array of numbers; one of the right dtype is kept."""
    import numpy as np

    return np.asarray(value, dtype=dtype)


UNIT_SIZE = 4


def units_of_text(text: str) -> bytes:
    """Return the code units of ``text``, little endian.

    Raises:
        UnicodeEncodeError: ``text`` has a lone surrogate.
    """
    narrow = text.encode("utf-16-le")
    units = bytearray(2 * len(narrow))
    units[0::4], units[1::4] = narrow[0::2], narrow[1::2]
    return bytes(units)


def text_of_units(units: bytes, order: str) -> str:
    """Return the text of code units in byte order ``order`` (``"<"`` or ``">"``).

    Raises:
        UnicodeDecodeError: ``units`` are not UTF-16.
    """
    low, high, above = (0, 1, units[2::4] + units[3::4])
    if order == ">":
        low, high, above = (3, 2, units[0::4] + units[1::4])
    if any(above):
        raise UnicodeDecodeError("utf-16", units, 0, len(units), "a code unit above 0xffff")
    narrow = bytearray(len(units) // 2)
    narrow[0::2], narrow[1::2] = units[low::4], units[high::4]
    return narrow.decode("utf-16-le")
