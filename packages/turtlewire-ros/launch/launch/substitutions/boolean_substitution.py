"""Logic over texts that are true or false."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from launch.frontend.expose import expose_substitution
from launch.substitution import Substitution
from launch.substitutions.substitution_failure import SubstitutionFailure
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions
from launch.utilities.type_utils import coerce_to_type

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType

__all__ = [
    "AllSubstitution",
    "AndSubstitution",
    "AnySubstitution",
    "NotSubstitution",
    "OrSubstitution",
    "as_bool",
]


def as_bool(context: LaunchContext, expression: Iterable[Substitution]) -> bool:
    """Read an expression as true or false, by YAML's rules: ``yes`` and ``on`` are true.

    Raises:
        SubstitutionFailure: The value is neither.
    """
    text = perform_substitutions(context, expression).strip()
    if text in ("0", "1"):
        return text == "1"
    try:
        return bool(coerce_to_type(text.lower(), bool))
    except ValueError as error:
        raise SubstitutionFailure(str(error)) from error


def _text(value: bool) -> str:
    return "true" if value else "false"


@expose_substitution("not")
class NotSubstitution(Substitution):
    """The opposite of a text.

    Args:
        value: The text.
    """

    def __init__(self, value: SomeSubstitutionsType) -> None:
        self._value = normalize_to_list_of_substitutions(value)

    @classmethod
    def parse(
        cls, data: Sequence[SomeSubstitutionsType]
    ) -> tuple[type[NotSubstitution], dict[str, Any]]:
        """Read ``$(not value)``."""
        if len(data) != 1:
            raise TypeError("not substitution expects 1 argument")
        return cls, {"value": data[0]}

    @property
    def value(self) -> list[Substitution]:
        """The text."""
        return self._value

    def describe(self) -> str:
        """Name the operands."""
        return f"NotSubstitution({' + '.join(part.describe() for part in self._value)})"

    def perform(self, context: LaunchContext) -> str:
        """``true`` or ``false``."""
        return _text(not as_bool(context, self._value))


class _Two(Substitution):
    """Combines two texts.

    Args:
        left: The one.
        right: The other.
    """

    def __init__(self, left: SomeSubstitutionsType, right: SomeSubstitutionsType) -> None:
        self._left = normalize_to_list_of_substitutions(left)
        self._right = normalize_to_list_of_substitutions(right)

    @classmethod
    def parse(cls, data: Sequence[SomeSubstitutionsType]) -> tuple[type[_Two], dict[str, Any]]:
        """Read the two operands."""
        if len(data) != 2:
            raise TypeError(f"{cls.__name__} expects 2 arguments")
        return cls, {"left": data[0], "right": data[1]}

    @property
    def left(self) -> list[Substitution]:
        """The one."""
        return self._left

    @property
    def right(self) -> list[Substitution]:
        """The other."""
        return self._right

    def describe(self) -> str:
        """Name the operands."""
        left, right = (
            " + ".join(part.describe() for part in side) for side in (self._left, self._right)
        )
        return f"{type(self).__name__}({left} {right})"


@expose_substitution("and")
class AndSubstitution(_Two):
    """Whether both are true."""

    def perform(self, context: LaunchContext) -> str:
        """``true`` or ``false``."""
        left, right = as_bool(context, self._left), as_bool(context, self._right)
        return _text(left and right)


@expose_substitution("or")
class OrSubstitution(_Two):
    """Whether one of both is true."""

    def perform(self, context: LaunchContext) -> str:
        """``true`` or ``false``."""
        left, right = as_bool(context, self._left), as_bool(context, self._right)
        return _text(left or right)


class _Many(Substitution):
    """Combines any number of texts.

    Args:
        *args: The texts.
    """

    def __init__(self, *args: SomeSubstitutionsType) -> None:
        self._args = [normalize_to_list_of_substitutions(arg) for arg in args]

    @classmethod
    def parse(cls, data: Sequence[SomeSubstitutionsType]) -> tuple[type[_Many], dict[str, Any]]:
        """Read the operands."""
        return cls, {"args": list(data)}

    @property
    def args(self) -> list[list[Substitution]]:
        """The texts."""
        return self._args

    def describe(self) -> str:
        """Name the operands."""
        arguments = (" + ".join(part.describe() for part in arg) for arg in self._args)
        return f"{type(self).__name__}({' '.join(arguments)})"


@expose_substitution("any")
class AnySubstitution(_Many):
    """Whether at least one is true."""

    def perform(self, context: LaunchContext) -> str:
        """``true`` or ``false``."""
        return _text(any(as_bool(context, arg) for arg in self._args))


@expose_substitution("all")
class AllSubstitution(_Many):
    """Whether all are true."""

    def perform(self, context: LaunchContext) -> str:
        """``true`` or ``false``."""
        return _text(all(as_bool(context, arg) for arg in self._args))
