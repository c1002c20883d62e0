"""Hashes of types, as endpoints announce them."""

from __future__ import annotations

from .impl.hints import require

_VALUE_SIZE = 32


class TypeHash:
    """The hash of a type's definition.

    Args:
        version: Version of the scheme; -1 when the peer announced no hash.
        value: 32 bytes.
    """

    __slots__ = ("_value", "_version")
    __hash__ = None  # type: ignore[assignment]  # mutable

    def __init__(self, version: int = -1, value: bytes = bytes(_VALUE_SIZE)) -> None:
        self.version = version
        self.value = value

    @classmethod
    def from_string(cls, text: str) -> TypeHash:
        """Read ``RIHS01_<64 hex digits>``.

        Anything else, such as an empty string, means that no hash is known.
        """
        digits = text.removeprefix("RIHS01_")
        try:
            value = bytes.fromhex(digits)
        except ValueError:
            return cls()
        return cls(1, value) if len(value) == _VALUE_SIZE and digits != text else cls()

    @property
    def version(self) -> int:
        """Version of the scheme."""
        return self._version

    @version.setter
    def version(self, value: int) -> None:
        require(value, int)
        self._version = value

    @property
    def value(self) -> bytes:
        """The hash itself."""
        return self._value

    @value.setter
    def value(self, value: bytes) -> None:
        require(value, bytes)
        self._value = value

    def __eq__(self, other: object) -> bool:
        return (
            (self._version, self._value) == (other.version, other.value)
            if isinstance(other, TypeHash)
            else NotImplemented
        )

    def __str__(self) -> str:
        if self._version <= 0 or len(self._value) != _VALUE_SIZE:
            return "INVALID"
        return f"RIHS{self._version:02}_{self._value.hex()}"
