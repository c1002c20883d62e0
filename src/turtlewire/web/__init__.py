"""The one small HTTP and WebSocket server: static files and latest-wins streams, for browsers of this machine only."""

from __future__ import annotations

from turtlewire.web.server import Server, Session

__all__ = ["Server", "Session"]
