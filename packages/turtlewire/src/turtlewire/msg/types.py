"""The types of interface fields, named as in ROS 2's ``rosidl_parser.definition``.

``str(type)`` returns ROS 2's spelling (``sequence<double, 3>``,
``geometry_msgs/Vector3[2]``), compares by value and is hashable.
"""

from __future__ import annotations

INTEGER_RANGES = {
    "int8": (-(2**7), 2**7 - 1),
    "uint8": (0, 2**8 - 1),
    "int16": (-(2**15), 2**15 - 1),
    "uint16": (0, 2**16 - 1),
    "int32": (-(2**31), 2**31 - 1),
    "uint32": (0, 2**32 - 1),
    "int64": (-(2**63), 2**63 - 1),
    "uint64": (0, 2**64 - 1),
}

FLOATING_POINT_TYPES = ("float", "double")

TYPE_CODES = {
    "int8": "b",
    "uint8": "B",
    "int16": "h",
    "uint16": "H",
    "int32": "i",
    "uint32": "I",
    "int64": "q",
    "uint64": "Q",
    "float": "f",
    "double": "d",
}
"""The letter of each numeric type, the same in ``struct`` formats and in ``array.array``."""

_IN_MSG_FILE = {"boolean": "bool", "octet": "byte", "float": "float32", "double": "float64"}


class AbstractType:
    """Base of all types, with equality and hash by their parts."""

    __slots__ = ()

    def _parts(self) -> tuple[object, ...]:
        return tuple(
            getattr(self, slot)
            for cls in type(self).__mro__
            for slot in getattr(cls, "__slots__", ())
        )

    def __eq__(self, other: object) -> bool:
        return type(other) is type(self) and self._parts() == other._parts()

    def __hash__(self) -> int:
        return hash((type(self), self._parts()))

    def __repr__(self) -> str:
        return f"{type(self).__name__}({', '.join(repr(part) for part in self._parts())})"


class AbstractNestableType(AbstractType):
    """A type of which arrays and sequences may consist."""

    __slots__ = ()


class BasicType(AbstractNestableType):
    """A number, a ``boolean`` or an ``octet`` (the ``byte`` of .msg files).

    Attributes:
        typename: ``boolean``, ``octet``, ``float``, ``double``, ``int8`` … ``uint64``.
    """

    __slots__ = ("typename",)

    def __init__(self, typename: str) -> None:
        self.typename = typename

    def __str__(self) -> str:
        return self.typename


class NamespacedType(AbstractNestableType):
    """Another interface, nested.

    Attributes:
        namespaces: Package and subfolder, ``("geometry_msgs", "msg")``.
        name: Name in its namespace, ``"Vector3"``.
    """

    __slots__ = ("name", "namespaces")

    def __init__(self, namespaces: tuple[str, ...], name: str) -> None:
        self.namespaces = tuple(namespaces)
        self.name = name

    @classmethod
    def parse(cls, full_name: str) -> NamespacedType:
        """Type of a full name, ``"geometry_msgs/msg/Vector3"``."""
        *namespaces, name = full_name.split("/")
        return cls(tuple(namespaces), name)

    def namespaced_name(self) -> tuple[str, ...]:
        """Return all parts of the name, ``("geometry_msgs", "msg", "Vector3")``."""
        return (*self.namespaces, self.name)

    @property
    def full_name(self) -> str:
        """The name as the registry knows it, ``"geometry_msgs/msg/Vector3"``."""
        return "/".join(self.namespaced_name())

    def __str__(self) -> str:
        return f"{self.namespaces[0]}/{self.name}"


class NamedType(AbstractNestableType):
    """A type with its own name, such as a typedef.

    Attributes:
        name: The name.
    """

    __slots__ = ("name",)

    def __init__(self, name: str) -> None:
        self.name = name

    def __str__(self) -> str:
        return self.name


class AbstractGenericString(AbstractNestableType):
    """Text of any kind; ``maximum_size`` exists on the bounded ones."""

    __slots__ = ()

    def has_maximum_size(self) -> bool:
        """Return True if the length is limited."""
        return hasattr(self, "maximum_size")


class AbstractString(AbstractGenericString):
    """Text sent as UTF-8."""

    __slots__ = ()


class AbstractWString(AbstractGenericString):
    """Text sent as wide characters."""

    __slots__ = ()


class UnboundedString(AbstractString):
    """``string``."""

    __slots__ = ()

    def __str__(self) -> str:
        return "string"


class BoundedString(AbstractString):
    """``string<=N``.

    Attributes:
        maximum_size: Largest length, in bytes of UTF-8 without the terminator.
    """

    __slots__ = ("maximum_size",)

    def __init__(self, maximum_size: int) -> None:
        self.maximum_size = maximum_size

    def __str__(self) -> str:
        return f"string<{self.maximum_size}>"


class UnboundedWString(AbstractWString):
    """``wstring``."""

    __slots__ = ()

    def __str__(self) -> str:
        return "wstring"


class BoundedWString(AbstractWString):
    """``wstring<=N``.

    Attributes:
        maximum_size: Largest number of characters.
    """

    __slots__ = ("maximum_size",)

    def __init__(self, maximum_size: int) -> None:
        self.maximum_size = maximum_size

    def __str__(self) -> str:
        return f"wstring<{self.maximum_size}>"


class AbstractNestedType(AbstractType):
    """Several values of one type.

    Attributes:
        value_type: Type of each value.
    """

    __slots__ = ("value_type",)

    def __init__(self, value_type: AbstractType) -> None:
        self.value_type = value_type

    def has_maximum_size(self) -> bool:
        """Return True if the number of values is limited."""
        return hasattr(self, "maximum_size")


class Array(AbstractNestedType):
    """``T[N]``: exactly ``size`` values."""

    __slots__ = ("size",)

    def __init__(self, value_type: AbstractType, size: int) -> None:
        super().__init__(value_type)
        self.size = size

    def has_maximum_size(self) -> bool:
        """Always true, as ROS 2 has it."""
        return True

    def __str__(self) -> str:
        return f"{self.value_type}[{self.size}]"


class AbstractSequence(AbstractNestedType):
    """A varying number of values."""

    __slots__ = ()


class BoundedSequence(AbstractSequence):
    """``T[<=N]``: at most ``maximum_size`` values."""

    __slots__ = ("maximum_size",)

    def __init__(self, value_type: AbstractType, maximum_size: int) -> None:
        super().__init__(value_type)
        self.maximum_size = maximum_size

    def __str__(self) -> str:
        return f"sequence<{self.value_type}, {self.maximum_size}>"


class UnboundedSequence(AbstractSequence):
    """``T[]``."""

    __slots__ = ()

    def __str__(self) -> str:
        return f"sequence<{self.value_type}>"


def sequence_of(value_type: AbstractType, maximum_size: int | None) -> AbstractSequence:
    """Return the type of a sequence, as ROS 2's IDL parser makes it.

    Args:
        value_type: The type of the values.
        maximum_size: None for a sequence without a bound. That parser takes the bound of wide
            strings for the sequence's, too, and type hashes depend on it.
    """
    if maximum_size is None and isinstance(value_type, BoundedWString):
        maximum_size = value_type.maximum_size
    if maximum_size is None:
        return UnboundedSequence(value_type)
    return BoundedSequence(value_type, maximum_size)


def type_in_msg_file(type_: AbstractType) -> str:
    """Return a type as .msg files spell it, for example ``float64[<=3]``."""
    if isinstance(type_, AbstractNestedType):
        bound = f"<={type_.maximum_size}" if isinstance(type_, BoundedSequence) else ""
        size = type_.size if isinstance(type_, Array) else bound
        return f"{type_in_msg_file(type_.value_type)}[{size}]"
    if isinstance(type_, (BoundedString, BoundedWString)):
        kind = "string" if isinstance(type_, BoundedString) else "wstring"
        return f"{kind}<={type_.maximum_size}"
    name = str(type_)
    return name if isinstance(type_, NamespacedType) else _IN_MSG_FILE.get(name, name)
