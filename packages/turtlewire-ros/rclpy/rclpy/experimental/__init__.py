"""What ROS 2 calls experimental."""

from .events_executor import EventsExecutor

__all__ = ["EventsExecutor"]
