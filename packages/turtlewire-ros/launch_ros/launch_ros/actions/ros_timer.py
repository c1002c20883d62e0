"""Delays actions by the time of ROS."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from launch.actions import TimerAction
from launch.frontend import expose_action
from launch.some_substitutions_type import SomeSubstitutionsType_types_tuple
from launch_ros.ros_adapters import get_ros_node
from launch_ros.utilities.scope import global_parameters

if TYPE_CHECKING:
    import asyncio

    from launch.launch_context import LaunchContext

__all__ = ["ROSTimer", "RosTimer", "SomeSubstitutionsType_types_tuple"]


@expose_action("ros_timer")
class ROSTimer(TimerAction):
    """Visits actions after a period of ROS time.

    ROS time is that of ``/clock`` if the scope sets ``use_sim_time``, else the system's. The end
    of the launch cancels the timer, because it also ends the node that the timer belongs to.

    Args:
        period: Seconds: a number, or a text that is one.
        actions: The actions.
        **kwargs: See :class:`launch.actions.TimerAction`.
    """

    def _start_time(
        self, context: LaunchContext, loop: asyncio.AbstractEventLoop, expire: Callable[[], None]
    ) -> Callable[[], object]:
        from rclpy.parameter import Parameter

        node = get_ros_node(context)
        # The launch has one node, so its other timers then follow `/clock` as well.
        if ("use_sim_time", True) in global_parameters(context):
            node.set_parameters([Parameter("use_sim_time", value=True)])

        def end() -> None:
            node.destroy_timer(timer)
            # The timer runs on the thread of the launch's node, but actions belong to the event
            # loop.
            loop.call_soon_threadsafe(expire)

        # Started only when `end` can find it.
        timer = node.create_timer(self.seconds(context), end, autostart=False)
        timer.reset()
        return lambda: node.destroy_timer(timer)

    def _ends_at_shutdown(self, context: LaunchContext) -> bool:
        del context
        # Even without `cancel_on_shutdown`: the node ends, so the timer would never fire.
        return True


RosTimer = ROSTimer
