"""Wakes an executor with a guard condition, twice."""

from __future__ import annotations

import rclpy
from rclpy.executors import SingleThreadedExecutor


def main(args: list[str] | None = None) -> None:
    """Trigger, spin once, and again."""
    with rclpy.init(args=args):
        node = rclpy.create_node("test_node")
        executor = SingleThreadedExecutor()
        executor.add_node(node)

        def guard_condition_callback() -> None:
            node.get_logger().info("guard callback called")

        guard_condition = node.create_guard_condition(guard_condition_callback)
        for number in ("first", "second"):
            node.get_logger().info(f"{number} trigger")
            # Only wakes the executor; the callback runs in `spin_once`.
            guard_condition.trigger()
            executor.spin_once(timeout_sec=5.0)
        node.destroy_guard_condition(guard_condition)
