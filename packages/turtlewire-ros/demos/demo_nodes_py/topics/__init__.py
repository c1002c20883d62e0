"""Talkers and listeners on ``chatter``."""
