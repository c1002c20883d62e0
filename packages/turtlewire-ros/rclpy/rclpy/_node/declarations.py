"""Declarations of parameters, and checks of values against their descriptors.

Interprets ``(name, value or type, descriptor)``, applies values of the command line, and says why a
value is refused: its type is wrong, it is out of range, or the parameter is read-only.
"""

from __future__ import annotations

import math
from copy import copy
from typing import TYPE_CHECKING, Any

from rclpy.parameter import Parameter
from turtlewire.distro import LYRICAL, since

if TYPE_CHECKING:
    from collections.abc import Sequence

    from rcl_interfaces.msg import FloatingPointRange, IntegerRange, ParameterDescriptor

#: ROS 2's relative tolerance of comparisons with the ends and steps of a range of doubles.
_REL_TOL = 1e-6
#: The smallest and the largest integer that messages can hold.
_INT64_MIN, _INT64_MAX = -(2**63), 2**63 - 1
#: How the reason of a type conflict begins.
WRONG_TYPE = "Wrong parameter type"


def new_descriptor() -> ParameterDescriptor:
    """Return an empty descriptor."""
    from rcl_interfaces.msg import ParameterDescriptor

    return ParameterDescriptor()


def read_declaration(
    index: int, declaration: tuple[Any, ...]
) -> tuple[str, Any, ParameterDescriptor]:
    """Return name, default value (None without one) and descriptor with the type filled in.

    Raises:
        TypeError, ValueError: The declaration, the ``index``-th of a call, is malformed.
    """
    from rcl_interfaces.msg import ParameterDescriptor

    if not 1 <= len(declaration) <= 3:
        raise TypeError(
            f"Invalid parameter tuple length at index {index} in parameters list: {declaration}; "
            "expecting length between 1 and 3"
        )
    name, value, descriptor = (*declaration, None, None)[:3]
    if not isinstance(name, str):
        raise TypeError(f"First element {name} at index {index} in parameters list is not a str.")
    # An explicit None in third place is an error, as in ROS 2.
    if descriptor is None and len(declaration) < 3:
        descriptor = ParameterDescriptor()
    if not isinstance(descriptor, ParameterDescriptor):
        raise TypeError(
            f"Third element {descriptor} at index {index} in parameters list is not a "
            "ParameterDescriptor."
        )
    # A program may declare several parameters with one descriptor.
    descriptor = copy(descriptor)
    if len(declaration) == 1:
        _name_alone(name)
        descriptor.dynamic_typing = True
    if not isinstance(value, Parameter.Type):
        if value is not None and not descriptor.dynamic_typing:
            descriptor.type = _type_of(value)
        return name, value, descriptor
    if value is Parameter.Type.NOT_SET:
        raise ValueError(f"Cannot declare parameter {name} statically to be of type NOT_SET")
    if descriptor.dynamic_typing:
        raise ValueError(
            f"When declaring parameter {name} passing a descriptor with`dynamic_typing=True` "
            "is not allowed when the parameter type is specified"
        )
    descriptor.type = value.value
    return name, None, descriptor


def _type_of(value: Any) -> int:
    """Return the number of a default value's type.

    Raises:
        ValueError: ``value`` is a ``ParameterValue`` that is not set.
    """
    from rcl_interfaces.msg import ParameterType, ParameterValue

    if not isinstance(value, ParameterValue):
        return int(Parameter.Type.from_parameter_value(value).value)
    if value.type == ParameterType.PARAMETER_NOT_SET:
        raise ValueError(
            "Cannot declare a statically typed parameter with default value of type "
            "PARAMETER_NOT_SET"
        )
    return int(value.type)


def name_alone_text(name: str, ruling: str) -> str:
    """Return ROS 2's text about a declaration of a name alone, to the byte.

    Args:
        name: The name of the parameter.
        ruling: ``"deprecated"`` or ``"not allowed"``.
    """
    return (
        f"when declaring parameter named '{name}', declaring a parameter only providing its name "
        f"is {ruling}. You have to either:\n"
        '\t- Pass a name and a default value different to "PARAMETER NOT SET" '
        "(and optionally a descriptor).\n"
        "\t- Pass a name and a parameter type.\n"
        "\t- Pass a name and a descriptor with `dynamic_typing=True"
    )


def _name_alone(name: str) -> None:
    """Warn of a declaration without value, type or descriptor; Lyrical refuses it."""
    import warnings

    if since(LYRICAL):
        raise TypeError(name_alone_text(name, "not allowed"))
    # The program's line, which called `Node.declare_parameter`.
    warnings.warn(name_alone_text(name, "deprecated"), stacklevel=6)


def default(name: str, value: Any) -> Parameter:
    """Return the parameter with its default value, which may be a ``ParameterValue``."""
    from rcl_interfaces import msg

    if isinstance(value, msg.ParameterValue):
        return Parameter.from_parameter_msg(msg.Parameter(name=name, value=value))
    return Parameter(name, value=value)


def override(name: str, value: Any, descriptor: ParameterDescriptor) -> Parameter:
    """Return the parameter that the command line gives."""
    # An empty list in YAML has no type: the declared one applies.
    if value == [] and Parameter.Type(descriptor.type).name.endswith("_ARRAY"):
        return Parameter(name, Parameter.Type(descriptor.type), value)
    return Parameter(name, value=value)


def yaml_hint(parameter: Parameter, expected: Parameter.Type) -> str:
    """Return a hint how to write a value of the expected type on the command line."""
    if expected is Parameter.Type.STRING:
        return f"YAML reads a string in quotes: -p {parameter.name}:='\"{parameter.value}\"'"
    if expected is Parameter.Type.DOUBLE and parameter.type_ is Parameter.Type.INTEGER:
        return f"YAML reads a double with a point in it: -p {parameter.name}:={parameter.value}.0"
    return ""


def refusal(
    parameter: Parameter,
    descriptor: ParameterDescriptor,
    *,
    declaring: bool = False,
) -> str:
    """Return why ``parameter`` must not be set; an empty string if it may.

    Args:
        parameter: The new value.
        descriptor: What was declared.
        declaring: Then a read-only parameter gets its value, and a typed one may stay without.
    """
    if descriptor.read_only and not declaring:
        return f"Trying to set a read-only parameter: {parameter.name}."
    if parameter.type_ is Parameter.Type.NOT_SET:
        return (
            ""
            if declaring or descriptor.dynamic_typing
            else "Static parameter cannot be undeclared"
        )
    if not descriptor.dynamic_typing and descriptor.type != parameter.type_.value:
        return f"{WRONG_TYPE}, expected '{Parameter.Type(descriptor.type)}' got '{parameter.type_}'"
    if parameter.type_ in {Parameter.Type.INTEGER, Parameter.Type.INTEGER_ARRAY}:
        return _integer_refusal(parameter, descriptor.integer_range)
    if parameter.type_ is Parameter.Type.DOUBLE and descriptor.floating_point_range:
        return _double_refusal(parameter, descriptor.floating_point_range[0])
    return ""


def _integer_refusal(parameter: Parameter, ranges: Sequence[IntegerRange]) -> str:
    value, is_array = parameter.value, parameter.type_ is Parameter.Type.INTEGER_ARRAY
    if is_array or not ranges:
        numbers = value if is_array else [value]
        large = next((each for each in numbers if not _INT64_MIN <= each <= _INT64_MAX), None)
        return "" if large is None else _out_of_range(parameter.name, large, _INT64_MIN, _INT64_MAX)
    # As in ROS 2, the limits come in either order, and both ends are valid even if the step does
    # not reach the upper one.
    low, high = sorted((ranges[0].from_value, ranges[0].to_value))
    if value in {low, high}:
        return ""
    if not low < value < high:
        return _out_of_range(parameter.name, value, low, high)
    if ranges[0].step and (value - low) % ranges[0].step:
        return (
            f"The parameter value for {parameter.name} is not a valid step. Min: {low}, "
            f"max: {high}, value: {value}, step: {ranges[0].step}"
        )
    return ""


def _double_refusal(parameter: Parameter, limits: FloatingPointRange) -> str:
    low, high = sorted((limits.from_value, limits.to_value))
    value = parameter.value
    if _is_close(value, low) or _is_close(value, high):
        return ""
    if not low < value < high:
        return f"Parameter {parameter.name} out of range Min: {low}, Max: {high}, value: {value}"
    if limits.step and not _is_on_step(value, low, limits.step):
        return (
            f"The parameter value for {parameter.name} is not close enough to a valid step. "
            f"Min: {low}, max: {high}, value: {value}, step: {limits.step}"
        )
    return ""


def _is_on_step(value: float, low: float, step: float) -> bool:
    # Not `%`: in floating point, 0.3 % 0.1 is nearly 0.1.
    steps = (value - low) / step
    # A step of 1e-300 is below the precision of the value: all are on one.
    return not math.isfinite(steps) or _is_close(low + round(steps) * step, value)


def _is_close(one: float, other: float) -> bool:
    return math.isclose(one, other, rel_tol=_REL_TOL)


def _out_of_range(name: str, value: int, low: int, high: int) -> str:
    return f"Parameter {name} out of range. Min: {low}, Max: {high}, value: {value}"
