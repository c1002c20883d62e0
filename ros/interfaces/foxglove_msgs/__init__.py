"""Interfaces of foxglove_msgs."""
