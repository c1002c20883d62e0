"""Visits an entity and all that its visit returns."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import asyncio

    from launch.launch_context import LaunchContext
    from launch.launch_description_entity import LaunchDescriptionEntity


def visit_all_entities_and_collect_futures(
    entity: LaunchDescriptionEntity, context: LaunchContext
) -> list[asyncio.Future[Any]]:
    """Visit an entity, and then, in depth, all entities that the visits return.

    Returns:
        The futures of entities that do not complete with their visit.
    """
    further = entity.visit(context)
    future = entity.get_asyncio_future()
    futures: list[asyncio.Future[Any]] = [] if future is None else [future]
    for sub_entity in further or ():
        futures += visit_all_entities_and_collect_futures(sub_entity, context)
    return futures
