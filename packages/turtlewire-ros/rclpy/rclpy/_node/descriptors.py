"""Check a parameter's value against its descriptor: type, read-only and range.

The reasons for a rejection are ROS 2's texts.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from rclpy.parameter import Parameter

if TYPE_CHECKING:
    import rcl_interfaces.msg

#: ROS 2's relative tolerance of comparisons with the ends and steps of a range of doubles.
PARAMETER_REL_TOL = 1e-6
#: How the reason of a type conflict begins.
WRONG_TYPE = "Wrong parameter type"
READ_ONLY = "Trying to set a read-only parameter: {}."


def refusal(
    parameter: Parameter,
    descriptor: rcl_interfaces.msg.ParameterDescriptor,
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
        return READ_ONLY.format(parameter.name)
    if parameter.type_ is Parameter.Type.NOT_SET:
        return (
            ""
            if declaring or descriptor.dynamic_typing
            else "Static parameter cannot be undeclared"
        )
    if not descriptor.dynamic_typing and descriptor.type != parameter.type_.value:
        return f"{WRONG_TYPE}, expected '{Parameter.Type(descriptor.type)}' got '{parameter.type_}'"
    if parameter.type_ is Parameter.Type.INTEGER and descriptor.integer_range:
        return _integer_refusal(parameter, descriptor.integer_range[0])
    if parameter.type_ is Parameter.Type.DOUBLE and descriptor.floating_point_range:
        return _double_refusal(parameter, descriptor.floating_point_range[0])
    return ""


def _integer_refusal(parameter: Parameter, limits: rcl_interfaces.msg.IntegerRange) -> str:
    # As in ROS 2, the limits come in either order, and both ends are valid even if the step does
    # not reach the upper one.
    low, high = sorted((limits.from_value, limits.to_value))
    value = parameter.value
    if value in {low, high}:
        return ""
    if not low < value < high:
        return _out_of_range(parameter, low, high)
    if limits.step and (value - low) % limits.step:
        return _off_step(parameter, low, high, limits.step)
    return ""


def _double_refusal(parameter: Parameter, limits: rcl_interfaces.msg.FloatingPointRange) -> str:
    low, high = sorted((limits.from_value, limits.to_value))
    value = parameter.value
    if _is_close(value, low) or _is_close(value, high):
        return ""
    if not low < value < high:
        return _out_of_range(parameter, low, high)
    if limits.step and not _is_on_step(value, low, limits.step):
        return _off_step(parameter, low, high, limits.step)
    return ""


def _is_on_step(value: float, low: float, step: float) -> bool:
    # Not `%`: in floating point, 0.3 % 0.1 is nearly 0.1.
    steps = (value - low) / step
    # A step of 1e-300 is below the precision of the value: all are on one.
    return not math.isfinite(steps) or _is_close(low + round(steps) * step, value)


def _is_close(one: float, other: float) -> bool:
    return math.isclose(one, other, rel_tol=PARAMETER_REL_TOL)


def _out_of_range(parameter: Parameter, low: float, high: float) -> str:
    return (
        f"Parameter {parameter.name} out of range. Min: {low}, Max: {high}, value: "
        f"{parameter.value}"
    )


def _off_step(parameter: Parameter, low: float, high: float, step: float) -> str:
    text = f"The parameter value for {parameter.name} is not a valid step."
    return f"{text} Min: {low}, max: {high}, value: {parameter.value}, step: {step}"
