"""The daemon as its clients see it; see :mod:`ros2cli.daemon`.

``ros2 daemon start`` starts it. The verbs of ``ros2`` do without it, because they discover the
nodes in about the time in which it would answer.
"""

from __future__ import annotations

import argparse
import errno
import functools
import os
from types import TracebackType
from typing import Any

from ros2cli.helpers import get_ros_domain_id, wait_for


class DaemonNode:
    """A connection to the daemon; its other attributes are the daemon's functions.

    Args:
        args: The command line.
    """

    def __init__(self, args: argparse.Namespace | None) -> None:
        # Here, because modules of extensions import this one only for `add_arguments`.
        import ros2cli.xmlrpc.marshal.rclpy  # noqa: F401  enters the types of the results
        from ros2cli.node.server import get_xmlrpc_server_url
        from ros2cli.xmlrpc.client import ServerProxy

        self._args = args
        self._proxy = ServerProxy(get_xmlrpc_server_url(), allow_none=True)

    @property
    def connected(self) -> bool:
        """True if the daemon answers."""
        from http.client import HTTPException
        from xmlrpc.client import Error

        try:
            return bool(self.methods)
        # It does not run, ends just now, or another program has its port.
        except (ConnectionError, HTTPException, Error):
            return False

    @property
    def methods(self) -> list[str]:
        """Names of the functions that the daemon offers.

        Raises:
            ConnectionRefusedError: The daemon does not run.
        """
        names: Any = self._proxy.system.listMethods()
        return [name for name in names if not name.startswith("system.")]

    def __getattr__(self, name: str) -> Any:
        if name == "_proxy":  # the constructor has failed
            raise AttributeError(name)
        return getattr(self._proxy, name)

    def __enter__(self) -> DaemonNode:  # noqa: PYI034  Self is not in Python 3.10
        self._proxy.__enter__()
        return self

    def __exit__(
        self,
        exc_type: type[BaseException] | None,
        exc_value: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        self._proxy.__exit__(exc_type, exc_value, traceback)


def is_daemon_running(args: argparse.Namespace | None) -> bool:
    """Return True if the daemon of the domain answers."""
    with DaemonNode(args) as node:
        return node.connected


def shutdown_daemon(args: argparse.Namespace | None, timeout: float | None = None) -> bool:
    """Ask the daemon to end; return False if it does not run.

    Args:
        args: The command line.
        timeout: Seconds to wait for its end; by default it is not waited for.

    Raises:
        RuntimeError: The daemon still answers after that time.
    """
    with DaemonNode(args) as node:
        if not node.connected:
            return False
        node.system.shutdown()
    if timeout is not None and not wait_for(lambda: not is_daemon_running(args), timeout):
        raise RuntimeError(f"The daemon has not ended within {timeout} s")
    return True


def spawn_daemon(
    args: argparse.Namespace | None,  # noqa: ARG001
    timeout: float | None = None,
    debug: bool = False,
) -> bool:
    """Start the daemon; return False if it runs already.

    Args:
        args: The command line.
        timeout: Seconds that its process may take to start.
        debug: Whether it prints on stderr what it is asked.

    Raises:
        OSError: The port cannot be opened.
        RuntimeError: The process did not start.
    """
    from ros2cli.background import daemonize
    from ros2cli.node.server import make_xmlrpc_server, serve_and_close

    try:
        # Here and not in the process: only one of two that are started at once gets the port.
        server = make_xmlrpc_server()
    except OSError as error:
        if error.errno == errno.EADDRINUSE:
            return False
        raise
    tags = {
        "name": "ros2-daemon",
        "ros-domain-id": get_ros_domain_id(),
        "rmw-implementation": os.environ.get("RMW_IMPLEMENTATION", ""),
    }
    try:
        serve = functools.partial(serve_and_close, server)
        daemonize(serve, tags=tags, timeout=timeout, debug=debug)
    finally:
        server.server_close()
    return True


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add ``--no-daemon``, with which a `NodeStrategy` does not ask the daemon."""
    from ros2cli.arguments import add_arguments as add
    from ros2cli.discovery import STRATEGY_ARGUMENTS

    add(parser, STRATEGY_ARGUMENTS[-1:])
