"""Interfaces of geographic_msgs."""
