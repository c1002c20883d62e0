"""Parameters with a type, and files of parameters."""

from __future__ import annotations

import contextlib
import os
from pathlib import Path
from typing import TYPE_CHECKING, Any

from launch.conditions import evaluate_condition_expression
from launch.frontend import Parser
from launch.frontend.type_utils import list_item_type
from launch.some_substitutions_type import SomeSubstitutionsType_types_tuple
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions
from launch_ros.utilities.evaluate_parameters import evaluate_value, typed

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType
    from launch.substitution import Substitution

__all__ = [
    "Parameter",
    "ParameterFile",
    "ParameterValue",
    "SomeSubstitutionsType_types_tuple",
]


class ParameterValue:
    """A value whose type is not left to YAML.

    Args:
        value: The value, possibly with substitutions.
        value_type: ``str``, ``int``, ``float``, ``bool`` or ``List[...]`` of one; None leaves it to
            YAML.
    """

    def __init__(self, value: Any, *, value_type: Any = None) -> None:
        self._value = value
        self._value_type = value_type

    @property
    def value(self) -> Any:
        """The value."""
        return self._value

    @property
    def value_type(self) -> Any:
        """The type, or None."""
        return self._value_type

    def evaluate(self, context: LaunchContext) -> Any:
        """Return the value after its substitutions, with its type.

        Raises:
            ValueError: The text has no value of the type.
        """
        if self._value_type is None:
            return evaluate_value(context, self._value)
        item_type = list_item_type(self._value_type)
        if item_type is not None and isinstance(self._value, (list, tuple)):
            return [
                ParameterValue(item, value_type=item_type).evaluate(context) for item in self._value
            ]
        if isinstance(self._value, (bool, int, float)):
            # By way of text, as for substitutions: `typed` also checks that the value fits the
            # type.
            return typed(str(self._value), self._value_type)
        return typed(
            perform_substitutions(context, normalize_to_list_of_substitutions(self._value)),
            self._value_type,
        )


class Parameter:
    """One parameter; becomes ``-p name:=value`` of the node.

    Args:
        name: Its name.
        value: Its value.
        value_type: Its type; None leaves it to YAML.
    """

    def __init__(self, name: SomeSubstitutionsType, value: Any, *, value_type: Any = None) -> None:
        self._name = normalize_to_list_of_substitutions(name)
        self._value = ParameterValue(value, value_type=value_type)
        self._evaluated: tuple[str, Any] | None = None

    @property
    def name(self) -> str | list[Substitution]:
        """The name; before :meth:`evaluate`, the substitutions that produce it."""
        return self._name if self._evaluated is None else self._evaluated[0]

    @property
    def value(self) -> Any:
        """The value; before :meth:`evaluate`, the unevaluated argument."""
        return self._value.value if self._evaluated is None else self._evaluated[1]

    @property
    def value_type(self) -> Any:
        """The type of the value, or None."""
        return self._value.value_type

    def evaluate(self, context: LaunchContext) -> tuple[str, Any]:
        """Return the name and value, performed."""
        name = perform_substitutions(context, self._name)
        self._evaluated = name, self._value.evaluate(context)
        return self._evaluated


class ParameterFile:
    """A YAML file of parameters.

    Args:
        param_file: Its path.
        allow_substs: Whether its text holds substitutions such as ``$(var x)``; the node then gets
            a copy with them performed.
    """

    def __init__(
        self,
        param_file: SomeSubstitutionsType,
        *,
        allow_substs: bool | SomeSubstitutionsType = False,
    ) -> None:
        self._param_file = normalize_to_list_of_substitutions(param_file)
        self._allow_substs: bool | list[Substitution] = (
            allow_substs
            if isinstance(allow_substs, bool)
            else normalize_to_list_of_substitutions(allow_substs)
        )
        self._allowed: bool | None = None
        self._copy: str | None = None

    @property
    def param_file(self) -> list[Substitution]:
        """The path of the file."""
        return self._param_file

    @property
    def allow_substs(self) -> bool | list[Substitution]:
        """True if its text holds substitutions; before :meth:`evaluate` as it was given."""
        return self._allow_substs if self._allowed is None else self._allowed

    def copy(self) -> ParameterFile:
        """Return the same file, for another node."""
        return ParameterFile(self._param_file, allow_substs=self._allow_substs)

    def evaluate(self, context: LaunchContext) -> Path:
        """Return the path of the file, or of its copy.

        Raises:
            OSError: The file cannot be read.
            SubstitutionFailure: A substitution has no value.
        """
        path = Path(perform_substitutions(context, self._param_file))
        given = self._allow_substs
        self._allowed = (
            given if isinstance(given, bool) else evaluate_condition_expression(context, given)
        )
        if not self._allowed:
            return path
        import tempfile

        # Performed as a whole, so a `$(…)` in a comment of the file counts as well.
        text = perform_substitutions(
            context, Parser().parse_substitution(path.read_text(encoding="utf-8"))
        )
        with tempfile.NamedTemporaryFile(
            "w", prefix="launch_params_", delete=False, encoding="utf-8"
        ) as file:
            file.write(text)
        self._copy = file.name
        return Path(file.name)

    def cleanup(self) -> None:
        """Remove the copy."""
        if self._copy is not None:
            with contextlib.suppress(FileNotFoundError):
                os.unlink(self._copy)
            self._copy = None
