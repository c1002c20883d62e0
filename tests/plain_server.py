"""Servers for pages: a folder without policies, a proxy below a path, a host that can go."""

import asyncio
import contextlib
import queue
import shutil
import ssl
import subprocess
import threading
from functools import partial
from urllib.parse import urlsplit

import pytest
import served_pages
import static_server


@contextlib.contextmanager
def plain_server(folder):
    """Serve a folder on loopback; yields the port."""
    with served_pages.static(folder) as address:
        yield urlsplit(address).port


@contextlib.asynccontextmanager
async def _closing(writer):
    """Close a connection at the end, before its loop ends."""
    try:
        yield
    finally:
        writer.transport.abort()
        with contextlib.suppress(OSError):
            await writer.wait_closed()


async def _pipe(reader, writer):
    with contextlib.suppress(OSError):  # either side has ended the connection
        while data := await reader.read(65536):
            writer.write(data)
            await writer.drain()
    writer.close()


async def _forward(prefix, target, reader, writer):
    async with _closing(writer):
        method, path, version = (await reader.readline()).split(b" ")
        if not path.startswith(prefix):
            return
        from_target, to_target = await asyncio.open_connection("127.0.0.1", target)
        async with _closing(to_target):
            to_target.write(b" ".join((method, b"/" + path.removeprefix(prefix), version)))
            await asyncio.gather(_pipe(reader, to_target), _pipe(from_target, writer))


@contextlib.contextmanager
def path_proxy(target, prefix, tls=None):
    """Serve the server at the port ``target`` below a path; yields the proxy's port.

    Like jupyter-server-proxy, it keeps the ``Host`` of each request. With ``tls``, an
    `ssl.SSLContext`, it answers at an https address.
    """
    started = queue.SimpleQueue()

    async def serve():
        ending = asyncio.Event()
        forward = partial(_forward, prefix.encode(), target)
        async with await asyncio.start_server(forward, "127.0.0.1", 0, ssl=tls) as server:
            started.put((server, asyncio.get_running_loop(), ending))
            await ending.wait()
            server.close()
            tasks = asyncio.all_tasks() - {asyncio.current_task()}
            for task in tasks:
                task.cancel()
            await asyncio.gather(*tasks, return_exceptions=True)

    thread = threading.Thread(target=asyncio.run, args=(serve(),))
    thread.start()
    server, loop, ending = started.get()
    try:
        yield server.sockets[0].getsockname()[1]
    finally:
        loop.call_soon_threadsafe(ending.set)
        thread.join()


def self_signed(folder):
    """Return a TLS context with a new certificate, which no browser trusts."""
    openssl = shutil.which("openssl")
    if openssl is None:
        pytest.skip("needs openssl (Debian: apt install openssl)")
    key, certificate = folder / "key.pem", folder / "certificate.pem"
    subprocess.run(
        f"{openssl} req -x509 -newkey ec -pkeyopt ec_paramgen_curve:P-256 -noenc -days 2 "
        f"-subj /CN=proxy -keyout {key} -out {certificate}".split(),
        check=True,
        capture_output=True,
    )
    context = ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER)
    context.load_cert_chain(certificate, key)
    return context


#: Loading Python takes seconds, and the machine may be busy.
LONG_MS = 100_000


class Host:
    """The server of `scripts/docs --serve` and `scripts/lesson --serve`; it can be switched off."""

    def __init__(self, folder):
        static_server.StaticPages.log_message = lambda *_: None
        self._server = static_server.static_server(folder, 0)
        self.url = f"http://localhost:{self._server.server_address[1]}/"
        self._thread = threading.Thread(target=self._server.serve_forever)
        self._thread.start()
        self.is_open = True

    def close(self):
        if self.is_open:
            self.is_open = False
            self._server.shutdown()
            self._thread.join()
            self._server.server_close()
