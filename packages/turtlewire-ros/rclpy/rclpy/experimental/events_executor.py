"""The events executor of ROS 2.

All executors here are driven by events; this one is the single-threaded one under its name.
"""

from rclpy.executors import SingleThreadedExecutor


class EventsExecutor(SingleThreadedExecutor):
    """Runs callbacks in the thread that spins, woken by events."""
