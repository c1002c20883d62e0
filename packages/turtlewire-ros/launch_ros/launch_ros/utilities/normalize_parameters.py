"""Parameters as a launch file writes them, in one form."""

from __future__ import annotations

from collections.abc import Mapping
from importlib import import_module
from pathlib import Path
from typing import Any

from launch.some_substitutions_type import SomeSubstitutionsType_types_tuple
from launch.substitution import Substitution
from launch.substitutions import TextSubstitution
from launch.utilities import normalize_to_list_of_substitutions

__all__ = [
    "SomeSubstitutionsType_types_tuple",
    "normalize_parameter_dict",
    "normalize_parameters",
]


def normalize_parameter_dict(
    parameters: Mapping[Any, Any], *, _prefix: Any = None
) -> dict[tuple[Substitution, ...], Any]:
    """Return names as tuples of substitutions, joined by dots; substituted values as tuples.

    Raises:
        TypeError: The argument is not a mapping, or a name is neither a string nor substitutions.
    """
    if not isinstance(parameters, Mapping):
        raise TypeError(f"expected a mapping of parameters, got '{parameters}'")
    prefix = () if _prefix is None else (*_prefix, TextSubstitution(text="."))
    normalized: dict[tuple[Substitution, ...], Any] = {}
    for key, value in parameters.items():
        name = (*prefix, *normalize_to_list_of_substitutions(key))
        if isinstance(value, Mapping):
            normalized.update(normalize_parameter_dict(value, _prefix=name))
        else:
            normalized[name] = _value(value)
    return normalized


def normalize_parameters(parameters: Any) -> list[Any]:
    """Convert files to ``ParameterFile``, and mappings with :func:`normalize_parameter_dict`.

    Raises:
        TypeError: The argument is not a list, or an item is neither a file nor parameters.
    """
    if isinstance(parameters, (str, Path, Substitution)) or not hasattr(parameters, "__iter__"):
        raise TypeError("Expecting a list of parameter files or parameter dictionaries")
    if isinstance(parameters, Mapping):
        parameters = [parameters]
    # Imported by name: that module itself imports from this package.
    file_type = import_module("launch_ros.parameter_descriptions").ParameterFile
    normalized: list[Any] = []
    for parameter in parameters:
        if isinstance(parameter, Mapping):
            normalized.append(normalize_parameter_dict(parameter))
        elif hasattr(parameter, "evaluate"):
            normalized.append(parameter)
        elif isinstance(parameter, (str, Path, Substitution, list, tuple)):
            normalized.append(file_type(parameter))
        else:
            raise TypeError(
                "Expecting a parameter file, a mapping of parameters or a Parameter, got "
                f"'{parameter}' of type '{type(parameter)}'"
            )
    return normalized


def _value(value: Any) -> Any:
    if isinstance(value, Substitution):
        return (value,)
    if isinstance(value, list):
        return tuple(value)
    return value
