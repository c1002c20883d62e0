"""What an action that runs a process is, for the handlers of the events of processes."""

from __future__ import annotations

from launch.action import Action

__all__ = ["ProcessAction"]


class ProcessAction(Action):
    """An action that runs a process; ROS 2's is ``ExecuteLocal``."""
