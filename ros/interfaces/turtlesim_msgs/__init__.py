"""Interfaces of turtlesim in Kilted and later."""
