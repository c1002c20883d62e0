"""``ros2 run rclpy_components component_container``: a process that waits for components."""

from __future__ import annotations

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy_components.component_manager import ComponentManager


def main(args: list[str] | None = None) -> None:
    """Run until Ctrl-C."""
    rclpy.init(args=args)
    manager = None
    try:
        manager = ComponentManager()
        rclpy.spin(manager)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        rclpy.try_shutdown()
        if manager is not None:
            manager.destroy_node()


if __name__ == "__main__":
    main()
