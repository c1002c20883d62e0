"""ROS nodes, parameters, remappings and namespaces in launch files."""

from __future__ import annotations

from launch_ros import (
    actions,
    descriptions,
    event_handlers,
    events,
    parameter_descriptions,
    substitutions,
)
from launch_ros.parameters_type import SomeParameters, SomeParametersDict, SomeParameterValue
from launch_ros.remap_rule_type import RemapRule, SomeRemapRule, SomeRemapRules

__all__ = [
    "RemapRule",
    "SomeParameterValue",
    "SomeParameters",
    "SomeParametersDict",
    "SomeRemapRule",
    "SomeRemapRules",
    "actions",
    "descriptions",
    "event_handlers",
    "events",
    "parameter_descriptions",
    "substitutions",
]
