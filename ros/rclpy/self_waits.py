"""Async callbacks that wait for themselves: they await a service that is held up by their own callback group."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

from .client import Client
from .service import Service

if TYPE_CHECKING:
    from collections.abc import Collection, Iterable

    from .entity import Entity
    from .node import Node

__all__ = ["SelfWaits"]

_PATIENCE_NS = 1_000_000_000


class SelfWaits:
    """Services that are held up by a callback which may be waiting for them; one that stays so for a second is warned of."""

    def __init__(self) -> None:
        self._due: dict[Service, int] = {}

    def held_up(self, entity: Entity, suspended: Collection[Entity], nodes: Iterable[Node]) -> None:
        """An entity has work that its group does not let it do; ``suspended``: whose async callbacks await something.

        It counts when it is a service, one of those callbacks holds its group, and a client of
        ``nodes`` waits for its response.
        """
        if isinstance(entity, Service) and any(
            other.callback_group is entity.callback_group for other in suspended
        ):
            clients: list[Client] = [
                client for node in nodes for client in node._rclpy_endpoints.of(Client)
            ]
            if any(
                client._pending and client._wire.service == entity._wire.service
                for client in clients
            ):
                self._due[entity] = time.monotonic_ns() + _PATIENCE_NS

    def goes_on(self, entity: Entity) -> None:
        """It may work again, or is gone."""
        self._due.pop(entity, None)  # type: ignore[call-overload] # others are just not in it

    def bounded(self, timeout_ns: int | None) -> int | None:
        """How long to wait before :meth:`warn` is due."""
        if not self._due:
            return timeout_ns
        left = max(0, min(list(self._due.values()), default=0) - time.monotonic_ns())
        return left if timeout_ns is None else min(left, timeout_ns)

    def warn(self) -> None:
        """Say what has been held up for too long, once."""
        for service, due in list(self._due.items()):
            if time.monotonic_ns() >= due:
                self._due.pop(service, None)
                name = service._wire.service
                service._logger.warning(
                    f"An async callback awaits, and service '{name}', which was called, cannot run before it ends: both are in one "
                    "callback group. If it awaits that service, it waits for ever: give the service a callback group of its own"
                )
