"""Starts, watches and stops groups of processes that a launch file describes.

=================================  ========================================================
module                             contents
=================================  ========================================================
`launch_service`                   the event loop, the order of events, signals
`launch_context`                   the view of a launch that its entities get
`_kernel`                          the state of one launch, and the protocols of its parts
`launch_description`               a list of entities
`launch_description_entity`        the base of descriptions and actions; declared arguments
`launch_description_source`        the source of a description
`launch_description_sources`       Python files, and files of any parser
`launch_introspector`              a description as a tree, for ``ros2 launch --print``
`action`, `actions`                the base of all actions; one module for each action
`condition`, `conditions`          the base of conditions; if, unless, equals
`event`, `events`                  the base of events; one module for each
`event_handler`, `event_handlers`  reactions to events; the ones that ROS 2 names
`substitution`, `substitutions`    text known only at run time: the base; one module for each
`descriptions`                     executables to run
`frontend`                         the common parts of the XML and YAML parsers
`child_process`                    a child process on the event loop
`process_settings`                 timeouts, terminal and respawn of a process
`process_output`                   output of a process: split into lines, logged
`logging`                          the screen, ``launch.log`` and files of single processes
`utilities`                        helpers of actions and substitutions
`invalid_launch_file_error`        the error of launch files that no loader can read
`some_actions_type`                the type of arguments that are actions
`some_entities_type`               the type of arguments that are entities
`some_substitutions_type`          the type of arguments that are text or substitutions
=================================  ========================================================
"""

from launch import (
    actions,
    conditions,
    event_handlers,
    events,
    launch_description_sources,
    logging,
    substitutions,
)
from launch.action import Action
from launch.condition import Condition
from launch.event import Event
from launch.event_handler import BaseEventHandler, EventHandler
from launch.invalid_launch_file_error import InvalidLaunchFileError
from launch.launch_context import LaunchContext
from launch.launch_description import LaunchDescription
from launch.launch_description_entity import LaunchDescriptionEntity
from launch.launch_description_source import LaunchDescriptionSource
from launch.launch_introspector import LaunchIntrospector
from launch.launch_service import LaunchService
from launch.some_actions_type import SomeActionsType
from launch.some_entities_type import SomeEntitiesType, SomeEntitiesType_types_tuple
from launch.some_substitutions_type import (
    SomeSubstitutionsType,
    SomeSubstitutionsType_types_tuple,
)
from launch.substitution import Substitution

__all__ = [
    "Action",
    "BaseEventHandler",
    "Condition",
    "Event",
    "EventHandler",
    "InvalidLaunchFileError",
    "LaunchContext",
    "LaunchDescription",
    "LaunchDescriptionEntity",
    "LaunchDescriptionSource",
    "LaunchIntrospector",
    "LaunchService",
    "SomeActionsType",
    "SomeEntitiesType",
    "SomeEntitiesType_types_tuple",
    "SomeSubstitutionsType",
    "SomeSubstitutionsType_types_tuple",
    "Substitution",
    "actions",
    "conditions",
    "event_handlers",
    "events",
    "launch_description_sources",
    "logging",
    "substitutions",
]
