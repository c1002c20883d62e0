"""Serves a folder of built pages to this machine's browsers, until Ctrl-C."""

from __future__ import annotations

import re
from functools import partial
from http import HTTPStatus
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from typing import TYPE_CHECKING, Any

from turtlewire.web.files import headers, script_hash
from turtlewire.web.origin import refusal

if TYPE_CHECKING:
    from io import BytesIO
    from typing import BinaryIO

__all__ = ["StaticPages", "static_server"]

#: Everything comes from this server; scripts in a page itself are allowed by their hashes.
_POLICY = (
    "default-src 'self'; script-src 'self' 'wasm-unsafe-eval'{scripts}; "
    "style-src 'self' 'unsafe-inline'; img-src 'self' data: blob:; connect-src 'self' data: blob:; "
    "worker-src 'self' blob:; object-src 'none'; base-uri 'self'; form-action 'self'; "
    "frame-ancestors 'none'"
)
_SCRIPT = re.compile(rb"<script\b([^>]*)>(.*?)</script>", re.DOTALL)


class StaticPages(SimpleHTTPRequestHandler):
    """Answers requests under this machine's names with the files below a folder, and nothing else.

    Args:
        directory: The folder.
    """

    def __init__(self, *args: Any, directory: Path, **kwargs: Any) -> None:
        self._root = directory.resolve()
        self._scripts = ""
        super().__init__(*args, directory=str(directory), **kwargs)

    def send_head(self) -> BytesIO | BinaryIO | None:
        """Send the status and the headers; the file, or None if the request is refused."""
        origins = self.headers.get_all("Origin", [])
        reason = refusal(self.headers.get_all("Host", []), origins)
        if reason is not None:
            self.send_error(HTTPStatus.FORBIDDEN, explain=f"Refused: {reason}")
            return None
        path = Path(self.translate_path(self.path))
        try:
            file = path / "index.html" if path.is_dir() else path
            # A link may lead out of the folder.
            is_here = file.is_file() and file.resolve().is_relative_to(self._root)
        except OSError:  # the name is too long
            is_here = False
        if not is_here:
            self.send_error(HTTPStatus.NOT_FOUND)
            return None
        if file.suffix == ".html":
            scripts = _SCRIPT.findall(file.read_bytes())
            inline = [text for kind, text in scripts if b"src=" not in kind]
            self._scripts = "".join(f" {script_hash(text)}" for text in inline)
        return super().send_head()

    def end_headers(self) -> None:
        """Add the policy of the page."""
        policy = _POLICY.format(scripts=self._scripts)
        for name, value in headers(policy, immutable=False).items():
            self.send_header(name, value)
        self._scripts = ""
        super().end_headers()


def static_server(folder: Path, port: int) -> ThreadingHTTPServer:
    """Return a server of a folder that listens on loopback; ``serve_forever`` runs it.

    Raises:
        OSError: The port is in use.
    """
    handler = partial(StaticPages, directory=folder)
    return ThreadingHTTPServer(("127.0.0.1", port), handler)
