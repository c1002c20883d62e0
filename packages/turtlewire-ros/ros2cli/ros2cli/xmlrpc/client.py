"""The client of Python's library."""

from xmlrpc.client import ProtocolError, ServerProxy

__all__ = ["ProtocolError", "ServerProxy"]
