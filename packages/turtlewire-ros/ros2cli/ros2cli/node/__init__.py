"""Nodes with which commands query the graph."""

__all__ = ["HIDDEN_NODE_PREFIX", "NODE_NAME_PREFIX"]

HIDDEN_NODE_PREFIX = "_"
NODE_NAME_PREFIX = HIDDEN_NODE_PREFIX + "ros2cli"
