"""The type of arguments that are actions."""

from launch.some_entities_type import SomeEntitiesType

__all__ = ["SomeActionsType"]

#: One action (or other entity) or several.
SomeActionsType = SomeEntitiesType
