"""Predicates over the nodes of a launch."""

from launch_ros.events.matchers.matches_node_name import matches_node_name

__all__ = ["matches_node_name"]
