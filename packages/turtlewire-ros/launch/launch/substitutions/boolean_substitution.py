"""Logic over texts that are true or false."""

from __future__ import annotations

import operator
from collections.abc import Callable, Iterable, Sequence
from typing import TYPE_CHECKING, Any

from launch.frontend.expose import expose_substitution
from launch.substitution import Substitution, described
from launch.substitutions.substitution_failure import SubstitutionFailure
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions
from launch.utilities.type_utils import coerce_to_type

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType


def as_bool(context: LaunchContext, expression: Iterable[Substitution]) -> bool:
    """Read an expression as true or false, by YAML's rules: ``yes`` and ``on`` are true.

    Raises:
        SubstitutionFailure: The value is neither.
    """
    text = perform_substitutions(context, expression).strip()
    # YAML reads these as integers.
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
        return f"NotSubstitution({described(self._value)})"

    def perform(self, context: LaunchContext) -> str:
        return _text(not as_bool(context, self._value))


class LeftRightLogicalSubstitution(Substitution):
    """Combines two texts, each of which is true or false.

    Both are read, so that an invalid one is always reported.

    Args:
        func: Combines the two values to one.
        left: The one text.
        right: The other.
    """

    def __init__(
        self,
        func: Callable[[bool, bool], bool],
        left: SomeSubstitutionsType,
        right: SomeSubstitutionsType,
    ) -> None:
        self._func = func
        self._left = normalize_to_list_of_substitutions(left)
        self._right = normalize_to_list_of_substitutions(right)

    @classmethod
    def parse(
        cls, data: Sequence[SomeSubstitutionsType]
    ) -> tuple[type[LeftRightLogicalSubstitution], dict[str, Any]]:
        """Read the two operands."""
        if len(data) != 2:
            raise TypeError(f"{cls.__name__} expects 2 arguments")
        return cls, {"left": data[0], "right": data[1]}

    @property
    def func(self) -> Callable[[bool, bool], bool]:
        """Combines the two values to one."""
        return self._func

    @property
    def left(self) -> list[Substitution]:
        """The one."""
        return self._left

    @property
    def right(self) -> list[Substitution]:
        """The other."""
        return self._right

    def describe(self) -> str:
        return f"{type(self).__name__}({described(self._left)} {described(self._right)})"

    def perform(self, context: LaunchContext) -> str:
        return _text(self._func(as_bool(context, self._left), as_bool(context, self._right)))


@expose_substitution("and")
class AndSubstitution(LeftRightLogicalSubstitution):
    """True if both texts are true."""

    def __init__(self, left: SomeSubstitutionsType, right: SomeSubstitutionsType) -> None:
        super().__init__(operator.and_, left, right)


@expose_substitution("or")
class OrSubstitution(LeftRightLogicalSubstitution):
    """True if at least one of two texts is true."""

    def __init__(self, left: SomeSubstitutionsType, right: SomeSubstitutionsType) -> None:
        super().__init__(operator.or_, left, right)


class ContainerSubstitution(Substitution):
    """Combines any number of texts, each of which is true or false.

    Args:
        func: Combines the values, in order and as far as it needs them, to one.
        *args: The texts.
        container: More texts.
    """

    def __init__(
        self,
        func: Callable[[Iterable[bool]], bool],
        *args: SomeSubstitutionsType,
        container: Iterable[SomeSubstitutionsType] | None = None,
    ) -> None:
        self._func = func
        self._args = [
            normalize_to_list_of_substitutions(arg) for arg in (*args, *(container or ()))
        ]

    @classmethod
    def parse(
        cls, data: Sequence[SomeSubstitutionsType]
    ) -> tuple[type[ContainerSubstitution], dict[str, Any]]:
        """Read the operands."""
        return cls, {"container": list(data)}

    @property
    def func(self) -> Callable[[Iterable[bool]], bool]:
        """Combines the values to one."""
        return self._func

    @property
    def args(self) -> list[list[Substitution]]:
        """The texts."""
        return self._args

    def describe(self) -> str:
        return f"{type(self).__name__}({' '.join(map(described, self._args))})"

    def perform(self, context: LaunchContext) -> str:
        return _text(self._func(as_bool(context, arg) for arg in self._args))


@expose_substitution("any")
class AnySubstitution(ContainerSubstitution):
    """True if at least one text is true."""

    def __init__(
        self,
        *args: SomeSubstitutionsType,
        container: Iterable[SomeSubstitutionsType] | None = None,
    ) -> None:
        super().__init__(any, *args, container=container)


@expose_substitution("all")
class AllSubstitution(ContainerSubstitution):
    """True if all texts are true."""

    def __init__(
        self,
        *args: SomeSubstitutionsType,
        container: Iterable[SomeSubstitutionsType] | None = None,
    ) -> None:
        super().__init__(all, *args, container=container)
