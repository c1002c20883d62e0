"""Several nodes in one process: a container that loads node classes when it is asked to."""

from __future__ import annotations

from rclpy_components.component_manager import ComponentManager

__all__ = ["ComponentManager"]
