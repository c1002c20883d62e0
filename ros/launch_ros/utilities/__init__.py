"""Helpers for parameters, names and remappings."""

from __future__ import annotations

from launch_ros.utilities.namespace_utils import (
    is_namespace_absolute,
    is_root_namespace,
    make_namespace_absolute,
    prefix_namespace,
)
from launch_ros.utilities.node_names import get_node_name_count
from launch_ros.utilities.parameter_values import evaluate_parameter_dict, evaluate_value

__all__ = [
    "evaluate_parameter_dict",
    "evaluate_value",
    "get_node_name_count",
    "is_namespace_absolute",
    "is_root_namespace",
    "make_namespace_absolute",
    "prefix_namespace",
]
