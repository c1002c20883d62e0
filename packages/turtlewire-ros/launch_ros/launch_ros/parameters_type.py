"""The type of arguments that are parameters of a node."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from launch.some_substitutions_type import (
    SomeSubstitutionsType,
    SomeSubstitutionsType_types_tuple,
)
from launch.substitution import Substitution
from launch_ros.parameter_descriptions import Parameter, ParameterFile, ParameterValue

__all__ = [
    "SomeParameterValue",
    "SomeParameterValue_types_tuple",
    "SomeParameters",
    "SomeParametersDict",
    "SomeSubstitutionsType_types_tuple",
]

#: A value: plain, substituted, typed, or a sequence of values of one type.
SomeParameterValue = (
    ParameterValue | SomeSubstitutionsType | int | float | bool | Sequence[Any] | bytes
)
#: The same for ``isinstance``.
SomeParameterValue_types_tuple = (
    ParameterValue,
    *SomeSubstitutionsType_types_tuple,
    int,
    float,
    bool,
    bytes,
)
#: Names (of substitutions, or nested) with values.
SomeParametersDict = Mapping[SomeSubstitutionsType, Any]
#: Files and mappings, in the order in which they take effect.
SomeParameters = Sequence[
    str | Path | Substitution | ParameterFile | Parameter | SomeParametersDict
]
