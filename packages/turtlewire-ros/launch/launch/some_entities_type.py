"""The type of arguments that are entities of a launch description."""

from collections.abc import Iterable

from launch.launch_description_entity import LaunchDescriptionEntity

#: One entity or several.
SomeEntitiesType = LaunchDescriptionEntity | Iterable[LaunchDescriptionEntity]

#: The same for ``isinstance``.
SomeEntitiesType_types_tuple = (LaunchDescriptionEntity, Iterable)
