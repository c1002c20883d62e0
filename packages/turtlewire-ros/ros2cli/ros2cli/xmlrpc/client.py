"""The client of Python's library."""

from __future__ import annotations

from xmlrpc.client import ProtocolError, ServerProxy

__all__ = ["ProtocolError", "ServerProxy"]
