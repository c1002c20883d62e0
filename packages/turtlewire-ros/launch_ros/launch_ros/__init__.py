"""ROS nodes, parameters, remappings and namespaces in launch files.

===========================================  =====================================================
module                                       contents
===========================================  =====================================================
`actions`                                    nodes, containers, namespaces, parameters
`descriptions`                               parameters, and nodes in containers
`_node`                                      common parts of actions and descriptions of nodes
`event_handlers`, `events`                   state transitions of lifecycle nodes
`parameter_descriptions`, `parameters_type`  parameters with a type, files of parameters
`remap_rule_type`                            the type of remapping rules
`ros_adapters`                               the launch's own node, for services and subscriptions
`substitutions`                              packages, executables and parameters
`utilities`                                  normalized parameters, names and remappings
===========================================  =====================================================
"""

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
