"""Entities, and lists of them, as one list."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from launch.launch_description_entity import LaunchDescriptionEntity


def normalize_to_list_of_entities(
    entities: LaunchDescriptionEntity | Iterable[Any],
) -> list[LaunchDescriptionEntity]:
    """Return one entity, or nested lists of entities, as one list.

    Raises:
        TypeError: An item is not an entity.
    """
    found: list[LaunchDescriptionEntity] = []
    pending: list[Any] = [entities]
    while pending:
        item = pending.pop()
        if isinstance(item, LaunchDescriptionEntity):
            found.append(item)
        elif isinstance(item, Iterable) and not isinstance(item, (str, bytes)):
            # Reversed, because the next item is taken from the end.
            pending.extend(reversed(list(item)))
        else:
            raise TypeError(f"expected launch entities, got '{item}' of type '{type(item)}'")
    return found
