"""The content of ``.msg``, ``.srv`` and ``.action`` files, with comments."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import Any

from turtlewire.msg import parser

PRIMITIVE_TYPES = [
    *("bool", "byte", "char", "float32", "float64", "int8", "uint8", "int16", "uint16"),
    *("int32", "uint32", "int64", "uint64", "string", "wstring", "duration", "time"),
]

_LOWER_NAME = re.compile(r"(?!.*__)(?!.*_$)[a-z][a-z0-9_]*")
_MESSAGE_NAME = re.compile(r"[A-Z][A-Za-z0-9]*")
_CONSTANT_NAME = re.compile(r"[A-Z]([A-Z0-9_]?[A-Z0-9]+)*")
_SUFFIXES = ("_Request", "_Response", "_Event", "_Goal", "_Result", "_Feedback")


class InvalidSpecification(Exception):
    """A text is not an interface."""


class InvalidServiceSpecification(InvalidSpecification):
    """A text is not a service."""


class InvalidActionSpecification(InvalidSpecification):
    """A text is not an action."""


class InvalidFieldDefinition(InvalidSpecification):
    """A line is not a field."""


class UnknownMessageType(InvalidSpecification):
    """A field has the type of a message that is not known."""


class InvalidResourceName(InvalidSpecification):
    """A name is not valid."""


class InvalidValue(Exception):
    """A text is not a value of a type.

    Args:
        type_: Name of the type.
        value_string: The text.
        message_suffix: Why not.
    """

    def __init__(self, type_: str, value_string: str, message_suffix: str | None = None) -> None:
        suffix = f": {message_suffix}" if message_suffix else ""
        super().__init__(f"value '{value_string}' can not be converted to type '{type_}'{suffix}")


def is_valid_package_name(name: str) -> bool:
    """Return True if it may be the name of a package."""
    return _LOWER_NAME.fullmatch(name) is not None


def is_valid_field_name(name: str) -> bool:
    """Return True if it may be the name of a field."""
    return _LOWER_NAME.fullmatch(name) is not None


def is_valid_message_name(name: str) -> bool:
    """Return True if it may be the name of a message, or of a part of a service or action."""
    # The parts of services and actions have names that the rule below forbids.
    for suffix in _SUFFIXES:
        name = name.removesuffix(suffix)
    return _MESSAGE_NAME.fullmatch(name.removeprefix("Sample_")) is not None


def is_valid_constant_name(name: str) -> bool:
    """Return True if it may be the name of a constant."""
    return _CONSTANT_NAME.fullmatch(name) is not None


class BaseType:
    """The type of a single value.

    Args:
        type_string: Its text, for example ``string<=3`` or ``geometry_msgs/Point``.
        context_package_name: Package of messages that are named without one.

    Attributes:
        pkg_name: Package of a message; None for others.
        type: Name without package and bound.
        string_upper_bound: Largest length of a bounded text; None for others.

    Raises:
        InvalidResourceName: It names no type.
    """

    __slots__ = ("pkg_name", "string_upper_bound", "type")

    def __init__(self, type_string: str, context_package_name: str | None = None) -> None:
        name, bounded, bound = type_string.partition("<=")
        self.pkg_name: str | None = None
        self.string_upper_bound: int | None = None
        if name in PRIMITIVE_TYPES:
            self.type = name
            if bounded:
                if name not in ("string", "wstring") or not bound.isdecimal() or not int(bound):
                    raise TypeError(f"the bound of '{type_string}' must be a positive number")
                self.string_upper_bound = int(bound)
            return
        package, slash, message = type_string.rpartition("/")
        self.pkg_name = package.removesuffix("/msg") if slash else context_package_name
        self.type = message
        if self.pkg_name is None or not is_valid_package_name(self.pkg_name):
            raise InvalidResourceName(f"'{type_string}' does not name a package of the type")
        if not is_valid_message_name(message):
            raise InvalidResourceName(f"'{message}' is not a valid message name")

    def is_primitive_type(self) -> bool:
        """Return True if it is not a message."""
        return self.pkg_name is None

    def __eq__(self, other: object) -> bool:
        return type(other) is type(self) and str(self) == str(other)

    def __hash__(self) -> int:
        return hash(str(self))

    def __str__(self) -> str:
        if self.pkg_name is not None:
            return f"{self.pkg_name}/{self.type}"
        bound = self.string_upper_bound
        return self.type if bound is None else f"{self.type}<={bound}"


class Type(BaseType):
    """The type of a field.

    Args:
        type_string: Its text, for example ``float64[9]``.
        context_package_name: Package of messages that are named without one.

    Attributes:
        is_array: Whether it has several values.
        array_size: How many, or how many at most; None if there is no limit.
        is_upper_bound: Whether there may be fewer.
    """

    __slots__ = ("array_size", "is_array", "is_upper_bound")

    def __init__(self, type_string: str, context_package_name: str | None = None) -> None:
        base, _, size = type_string.removesuffix("]").partition("[")
        self.is_array = type_string.endswith("]")
        self.is_upper_bound = size.startswith("<=")
        self.array_size: int | None = None
        number = size.removeprefix("<=")
        if self.is_array and size:
            if not number.isdecimal() or not int(number):
                raise TypeError(f"the size of '{type_string}' must be a positive number")
            self.array_size = int(number)
        super().__init__(base if self.is_array else type_string, context_package_name)

    def is_dynamic_array(self) -> bool:
        """Return True if the number of values varies."""
        return self.is_array and (self.array_size is None or self.is_upper_bound)

    def is_fixed_size_array(self) -> bool:
        """Return True if the number of values is fixed."""
        return self.is_array and not self.is_dynamic_array()

    def __eq__(self, other: object) -> bool:
        return super().__eq__(other)

    def __hash__(self) -> int:
        return super().__hash__()

    def __str__(self) -> str:
        size = "" if self.array_size is None else str(self.array_size)
        bound = "<=" if self.is_upper_bound else ""
        return super().__str__() + (f"[{bound}{size}]" if self.is_array else "")


def parse_value_string(type_: Type, value_string: str) -> Any:
    """Return the value of a text; an int for ``byte``.

    Raises:
        InvalidValue: The text is not a value of the type.
    """
    try:
        value = parser.parse_value(parser.parse_type("unused", str(type_)), value_string)
    except ValueError as error:
        raise InvalidValue(str(type_), value_string, str(error)) from error
    # The engine's bytes have the length 1; rosidl's are integers.
    if type_.type != "byte":
        return value
    return [each[0] for each in value] if type_.is_array else value[0]


class _Annotated:
    """Something with annotations: ``comment``, a list of lines, and ``unit``."""

    def __init__(self) -> None:
        self.annotations: dict[str, Any] = {}


class Field(_Annotated):
    """A field.

    Args:
        type_: Its type.
        name: Its name.
        default_value_string: Text of its default.

    Attributes:
        default_value: The default, or None.

    Raises:
        NameError: The name is not valid.
        InvalidValue: The text is not a value of the type.
    """

    def __init__(self, type_: Type, name: str, default_value_string: str | None = None) -> None:
        super().__init__()
        if not is_valid_field_name(name):
            raise NameError(f"'{name}' is not a valid field name: lower case, digits, underscores")
        self.type = type_
        self.name = name
        text = default_value_string
        self.default_value = None if text is None else parse_value_string(type_, text)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Field) and str(self) == str(other)

    __hash__ = None  # type: ignore[assignment]  # its annotations change

    def __str__(self) -> str:
        default = "" if self.default_value is None else f" {self.default_value!r}"
        return f"{self.type} {self.name}{default}"


class Constant(_Annotated):
    """A constant.

    Args:
        primitive_type: Name of its type.
        name: Its name.
        value_string: Text of its value.

    Raises:
        NameError: The name is not valid.
        InvalidValue: The text is not a value of the type.
    """

    __slots__ = ("annotations", "name", "type", "value")

    def __init__(self, primitive_type: str, name: str, value_string: str) -> None:
        super().__init__()
        if not is_valid_constant_name(name):
            raise NameError(f"'{name}' is not a valid constant name: upper case, digits, _")
        self.type = primitive_type
        self.name = name
        self.value = parse_value_string(Type(primitive_type), value_string)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Constant) and str(self) == str(other)

    __hash__ = None  # type: ignore[assignment]  # its annotations change

    def __str__(self) -> str:
        return f"{self.type} {self.name}={self.value!r}"


class MessageSpecification(_Annotated):
    """Fields and constants of a message.

    Raises:
        ValueError: Two have the same name.
    """

    def __init__(
        self, pkg_name: str, msg_name: str, fields: Sequence[Field], constants: Sequence[Constant]
    ) -> None:
        super().__init__()
        self.base_type = BaseType(f"{pkg_name}/{msg_name}")
        self.msg_name = msg_name
        self.fields = list(fields)
        self.constants = list(constants)
        for kind, named in (("fields", self.fields), ("constants", self.constants)):
            names = [each.name for each in named]
            twice = sorted({name for name in names if names.count(name) > 1})
            if twice:
                raise ValueError(f"the {kind} have a name twice: {', '.join(twice)}")

    def __eq__(self, other: object) -> bool:
        return isinstance(other, MessageSpecification) and (
            (self.base_type, self.fields, self.constants)
            == (other.base_type, other.fields, other.constants)
        )

    __hash__ = None  # type: ignore[assignment]  # its annotations change


class ServiceSpecification:
    """Request and response of a service."""

    def __init__(
        self,
        pkg_name: str,
        srv_name: str,
        request: MessageSpecification,
        response: MessageSpecification,
    ) -> None:
        self.pkg_name = pkg_name
        self.srv_name = srv_name
        self.request = request
        self.response = response


class ActionSpecification:
    """Goal, result and feedback of an action."""

    def __init__(
        self,
        pkg_name: str,
        action_name: str,
        goal: MessageSpecification,
        result: MessageSpecification,
        feedback: MessageSpecification,
    ) -> None:
        self.pkg_name = pkg_name
        self.action_name = action_name
        self.goal = goal
        self.result = result
        self.feedback = feedback
