"""Keeps the nodes of a launch apart from all others on this computer."""

from __future__ import annotations

import contextlib
from typing import TYPE_CHECKING

from launch.action import Action
from launch.event_handlers import OnShutdown
from turtlewire.testing import reserved_domain

if TYPE_CHECKING:
    from launch.event import Event
    from launch.launch_context import LaunchContext

_VARIABLE = "ROS_DOMAIN_ID"


class EnableRmwIsolation(Action):
    """Gives processes and contexts that start afterwards a ROS domain that no other process uses.

    It sets ``ROS_DOMAIN_ID``, and restores it when the launch shuts down.
    """

    def execute(self, context: LaunchContext) -> None:
        """Choose the domain.

        Raises:
            RuntimeError: All domains from 1 to 101 are in use.
        """
        reservation = contextlib.ExitStack()
        domain = reservation.enter_context(reserved_domain())
        former = context.environment.get(_VARIABLE)
        context.environment[_VARIABLE] = str(domain)

        def end(_event: Event, context: LaunchContext) -> None:
            if former is None:
                context.environment.pop(_VARIABLE, None)
            else:
                context.environment[_VARIABLE] = former
            reservation.close()

        # The newest handler comes first: two such actions end in reverse order.
        context.register_event_handler(OnShutdown(on_shutdown=end))
