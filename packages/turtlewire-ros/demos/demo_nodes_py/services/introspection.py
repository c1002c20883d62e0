"""The parameter with which the introspection demos are configured."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from rcl_interfaces.msg import SetParametersResult
from rclpy.parameter import Parameter
from rclpy.service_introspection import ServiceIntrospectionState

_STATES = {
    "disabled": ServiceIntrospectionState.OFF,
    "metadata": ServiceIntrospectionState.METADATA,
    "contents": ServiceIntrospectionState.CONTENTS,
}


def check(name: str, parameters: Sequence[Parameter]) -> SetParametersResult:
    """Reject values of the parameter other than the three words."""
    for parameter in parameters:
        if parameter.name != name:
            continue
        if parameter.type_ != Parameter.Type.STRING:
            return SetParametersResult(successful=False, reason="must be a string")
        if parameter.value not in _STATES:
            reason = "must be one of 'disabled', 'metadata', or 'contents'"
            return SetParametersResult(successful=False, reason=reason)
    return SetParametersResult(successful=True)


def state_of(name: str, parameters: Sequence[Parameter]) -> Iterator[ServiceIntrospectionState]:
    """Yield the states that values of the parameter ask for."""
    for parameter in parameters:
        if parameter.name == name:
            yield _STATES[parameter.value]
