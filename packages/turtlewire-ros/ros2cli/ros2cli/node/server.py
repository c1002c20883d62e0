"""The server of the daemon; see :mod:`ros2cli.daemon`."""

from __future__ import annotations

import argparse
import socket
import uuid
from contextlib import suppress
from typing import TYPE_CHECKING
from xmlrpc.server import SimpleXMLRPCRequestHandler

from ros2cli.helpers import before_invocation, get_ros_domain_id, pretty_print_call
from ros2cli.node.network_aware import NetworkAwareNode
from ros2cli.xmlrpc.local_server import LocalXMLRPCServer

if TYPE_CHECKING:
    from rclpy.context import Context

_BASE_PORT = 11511
_PATH = "/ros2cli/"
#: Seconds without a call after which the daemon ends.
IDLE_S = 2 * 60 * 60

#: Methods of the node that can be called; the last two since Lyrical.
_METHODS = (
    "get_name",
    "get_namespace",
    "get_node_names_and_namespaces",
    "get_node_names_and_namespaces_with_enclaves",
    "get_topic_names_and_types",
    "get_service_names_and_types",
    "get_action_names_and_types",
    "get_publisher_names_and_types_by_node",
    "get_publishers_info_by_topic",
    "get_subscriber_names_and_types_by_node",
    "get_subscriptions_info_by_topic",
    "get_service_names_and_types_by_node",
    "get_client_names_and_types_by_node",
    "get_action_server_names_and_types_by_node",
    "get_action_client_names_and_types_by_node",
    "count_publishers",
    "count_subscribers",
    "count_clients",
    "count_services",
    "get_clients_info_by_service",
    "get_servers_info_by_service",
)


class RequestHandler(SimpleXMLRPCRequestHandler):
    """Answers calls at one path, unless they come from a web page."""

    rpc_paths = (_PATH,)

    def do_POST(self) -> None:  # noqa: N802  the name is that of the base
        """Answer a call."""
        # A browser names the page that sends a request; web pages must not use the daemon.
        if "Origin" in self.headers:
            self.send_error(403)
        else:
            super().do_POST()


def get_port() -> int:
    """Return the port of the domain's daemon."""
    return _BASE_PORT + get_ros_domain_id()


def get_address() -> tuple[str, int]:
    """Return host and port of the domain's daemon."""
    return "127.0.0.1", get_port()


def get_xmlrpc_server_url(address: tuple[str, int] | None = None) -> str:
    """Return the URL of a daemon, by default of the domain's."""
    host, port = address or get_address()
    return f"http://{host}:{port}{_PATH}"


def make_xmlrpc_server() -> LocalXMLRPCServer:
    """Return a server that listens at the address of the domain's daemon.

    Raises:
        OSError: The port is in use, usually by the daemon.
    """
    return LocalXMLRPCServer(
        get_address(), requestHandler=RequestHandler, logRequests=False, allow_none=True
    )


def serve(server: LocalXMLRPCServer, *, timeout: float = IDLE_S) -> None:
    """Answer calls until one asks for the end, none comes for a time, or a signal comes.

    Args:
        server: See `make_xmlrpc_server`.
        timeout: Seconds without a call until the end.
    """
    import ros2cli.xmlrpc.marshal.rclpy  # noqa: F401  enters the types of the results

    name = f"_daemon_{get_ros_domain_id()}_{uuid.uuid4().hex}"
    is_over = False

    def end(reason: str) -> None:
        nonlocal is_over
        print(reason, flush=True)
        is_over = True

    with NetworkAwareNode(argparse.Namespace(node_name_suffix=name)) as node:
        server.register_introspection_functions()
        for method in _METHODS:
            function = getattr(node, method)
            server.register_function(before_invocation(function, pretty_print_call))
        server.register_function(lambda: end("Remote shutdown requested"), "system.shutdown")
        server.timeout = timeout
        vars(server)["handle_timeout"] = lambda: end("Shutdown due to timeout")
        print(f"Serving XML-RPC on {get_xmlrpc_server_url(_address(server))}", flush=True)
        watched: Context | None = None
        with suppress(KeyboardInterrupt):
            while not is_over and node.context.ok():
                if watched is not node.context:  # another one, after the addresses changed
                    watched = node.context
                    watched.on_shutdown(lambda: _wake(server))
                server.handle_request()


def _address(server: LocalXMLRPCServer) -> tuple[str, int]:
    host, port = server.socket.getsockname()[:2]
    return host, port


def _wake(server: LocalXMLRPCServer) -> None:
    """End the server's wait for a call, by a connection that asks for nothing."""
    with suppress(OSError):  # it has been closed
        socket.create_connection(_address(server)).close()


def serve_and_close(server: LocalXMLRPCServer, *, timeout: float = IDLE_S) -> None:
    """Answer calls as `serve` does, then close the server."""
    try:
        serve(server, timeout=timeout)
    finally:
        server.server_close()
