"""Servers like those of others: of a folder without policies, and a proxy below a path."""

from __future__ import annotations

import contextlib
import socket
import socketserver
import threading
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer


class Quiet(SimpleHTTPRequestHandler):
    def log_message(self, *_):
        pass


@contextlib.contextmanager
def plain_server(folder):
    """Serve a folder on loopback; yields the port."""
    with ThreadingHTTPServer(("127.0.0.1", 0), partial(Quiet, directory=folder)) as server:
        thread = threading.Thread(target=server.serve_forever)
        thread.start()
        try:
            yield server.server_address[1]
        finally:
            server.shutdown()
            thread.join()


class Forwarding(socketserver.StreamRequestHandler):
    """Forwards a request below a path, like jupyter-server-proxy, which keeps its ``Host``."""

    def handle(self):
        method, path, version = self.rfile.readline().split(b" ")
        prefix, port = self.server.prefix, self.server.target
        if not path.startswith(prefix):
            self.wfile.write(b"HTTP/1.1 404 Not Found\r\nContent-Length: 0\r\n\r\n")
            return
        with socket.create_connection(("127.0.0.1", port)) as target:
            target.sendall(b" ".join((method, b"/" + path.removeprefix(prefix), version)))
            back = threading.Thread(target=self._send_back, args=(target,))
            back.start()
            with contextlib.suppress(OSError):  # either side has ended the connection
                while data := self.rfile.read1():
                    target.sendall(data)
            with contextlib.suppress(OSError):
                target.shutdown(socket.SHUT_WR)
            back.join()

    def _send_back(self, target):
        with contextlib.suppress(OSError):
            while data := target.recv(65536):
                self.connection.sendall(data)
        with contextlib.suppress(OSError):
            self.connection.shutdown(socket.SHUT_RDWR)


@contextlib.contextmanager
def path_proxy(target, prefix):
    """Serve the server at the port ``target`` below a path; yields the proxy's port."""
    with socketserver.ThreadingTCPServer(("127.0.0.1", 0), Forwarding) as server:
        server.target, server.prefix = target, prefix.encode()
        thread = threading.Thread(target=server.serve_forever)
        thread.start()
        try:
            yield server.server_address[1]
        finally:
            server.shutdown()
            thread.join()
