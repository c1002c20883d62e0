"""``wstring`` on the wire: UTF-16 code units of four bytes each, as ROS 2 on Linux writes them.

ROS 2 holds a ``wstring`` as UTF-16; its typesupport for Cyclone DDS and Fast DDS widens each code
unit to a ``wchar_t``. So a character beyond the basic plane takes two units, eight bytes.
"""

from __future__ import annotations

__all__ = ["UNIT_SIZE", "text_of_units", "units_of_text"]

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
