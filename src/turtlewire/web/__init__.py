"""A small HTTP and WebSocket server for this machine's browsers: files and live values."""

from __future__ import annotations

from turtlewire.web.server import Server, Session

__all__ = ["Server", "Session"]
