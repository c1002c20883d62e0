"""Interfaces of control_msgs."""
