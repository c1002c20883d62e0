"""The daemon: a node that stays in the graph, and answers questions about it by XML-RPC.

Programs in any language can ask it at ``http://127.0.0.1:11511/ros2cli/``, with the number of the
domain added to the port. The verbs of ``ros2`` discover the nodes themselves.
"""

from __future__ import annotations

import argparse
import os
from collections.abc import Sequence

from ros2cli.helpers import before_invocation, bind, get_ros_domain_id, pretty_print_call
from ros2cli.node.network_aware import NetworkAwareNode
from ros2cli.node.server import (
    IDLE_S,
    RequestHandler,
    get_address,
    get_port,
    get_xmlrpc_server_url,
    make_xmlrpc_server,
    serve,
    serve_and_close,
)
from ros2cli.xmlrpc.local_server import LocalXMLRPCServer

__all__ = [
    "LocalXMLRPCServer",
    "NetworkAwareNode",
    "RequestHandler",
    "before_invocation",
    "bind",
    "get_address",
    "get_port",
    "get_ros_domain_id",
    "get_xmlrpc_server_url",
    "main",
    "make_xmlrpc_server",
    "pretty_print_call",
    "serve",
    "serve_and_close",
]


def main(*, argv: Sequence[str] | None = None) -> int | str:
    """Be the daemon of the domain; returns the exit status, or the text of an error.

    Args:
        argv: The command line.
    """
    parser = argparse.ArgumentParser(prog="_ros2_daemon", description="Answer calls of XML-RPC")
    parser.add_argument(
        "--timeout",
        metavar="N",
        type=int,
        default=IDLE_S,
        help="End after N seconds without a call (default: %(default)s)",
    )
    args = parser.parse_args(argv)
    try:
        server = make_xmlrpc_server()
    except OSError as error:
        return f"Cannot serve on {get_xmlrpc_server_url()}: {os.strerror(error.errno or 0)}"
    serve_and_close(server, timeout=args.timeout)
    return 0
