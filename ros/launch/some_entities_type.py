"""What may stand where entities of a launch description are wanted."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Union

from launch.launch_description_entity import LaunchDescriptionEntity

__all__ = ["SomeEntitiesType"]

#: One entity or several.
SomeEntitiesType = Union[LaunchDescriptionEntity, Iterable[LaunchDescriptionEntity]]
