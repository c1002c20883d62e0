"""Warnings about async callbacks that await a service blocked by their own callback group."""

from __future__ import annotations

import time
from collections.abc import Collection, Iterable
from typing import TYPE_CHECKING

from rclpy.service import Service

if TYPE_CHECKING:
    from .entity import Entity

_PATIENCE_NS = 1_000_000_000


class SelfWaits:
    """Services held up by a callback that may be waiting for them; warns after a second.

    Attributes:
        due: The services to warn about, and when.
    """

    def __init__(self) -> None:
        self.due: dict[Entity, tuple[Service, int]] = {}

    def held_up(
        self, entity: Entity, suspended: Collection[Entity], served: Iterable[Entity]
    ) -> None:
        """Note an entity that has work which its group does not let it do.

        It counts when it is a service, a suspended callback holds its group, and a client waits for
        its response.

        Args:
            entity: What is held up.
            suspended: Entities whose async callbacks await something.
            served: All entities of the executor.
        """
        if isinstance(entity, Service) and any(
            other.callback_group is entity.callback_group for other in suspended
        ):
            service = entity._wire.service  # `service_name` raises when another thread destroys it
            if any(other._awaits(service) for other in list(served)):
                self.due[entity] = (entity, time.monotonic_ns() + _PATIENCE_NS)

    def goes_on(self, entity: Entity) -> None:
        """Stop watching an entity that may run again or was released."""
        self.due.pop(entity, None)

    def bounded(self, timeout_ns: int | None) -> int | None:
        """Shorten a wait so that :meth:`warn` can be called in time."""
        moments = [due for _, due in list(self.due.values())]
        if not moments:
            return timeout_ns
        left = max(0, min(moments) - time.monotonic_ns())
        return left if timeout_ns is None else min(left, timeout_ns)

    def warn(self) -> None:
        """Say what has been held up for too long, once."""
        for service, due in list(self.due.values()):
            if time.monotonic_ns() >= due:
                self.due.pop(service, None)
                service._warn_of_self_wait()
