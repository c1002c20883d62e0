"""A node that goes on after the addresses of this computer have changed, for the daemon."""

from __future__ import annotations

import argparse
import functools
import inspect
from types import TracebackType
from typing import Any

from ros2cli.node.direct import DirectNode
from turtlewire.web.lan import interface_addresses as get_interfaces_ip_addresses

__all__ = ["NetworkAwareNode", "get_interfaces_ip_addresses"]


class NetworkAwareNode:
    """A `DirectNode` that is replaced if the addresses have changed since the last call.

    The middleware binds its sockets to the addresses at the start; a node that is hours old would
    see none of a network that was joined later.

    Args:
        args: See `DirectNode`.
    """

    def __init__(self, args: argparse.Namespace | None) -> None:
        self.args = args
        # Before the node is made, so that no change is missed.
        self._addresses = get_interfaces_ip_addresses()
        self.node = DirectNode(args)

    def __enter__(self) -> NetworkAwareNode:  # noqa: PYI034  Self is not in Python 3.10
        self.node.__enter__()
        return self

    def __exit__(
        self,
        exc_type: type[BaseException] | None,
        exc_value: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        self.node.__exit__(exc_type, exc_value, traceback)

    def __getattr__(self, name: str) -> Any:
        if name == "node":  # the constructor has failed
            raise AttributeError(name)
        found = getattr(self.node, name)
        if not inspect.ismethod(found):
            self.reset_if_addresses_changed()
            return getattr(self.node, name)

        @functools.wraps(found)
        def method(*args: Any, **kwargs: Any) -> Any:
            self.reset_if_addresses_changed()
            return getattr(self.node, name)(*args, **kwargs)

        return method

    def reset_if_addresses_changed(self) -> None:
        """Replace the node if the addresses have changed since it was made."""
        addresses = get_interfaces_ip_addresses()
        if addresses == self._addresses:
            return
        self._addresses = addresses
        self.node.__exit__(None, None, None)
        self.node = DirectNode(self.args)
        self.node.__enter__()
        print("Daemon node was reset")
