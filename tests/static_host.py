"""The server of built pages, and a host that can be switched off."""

from __future__ import annotations

import importlib.util
import threading

from tests.places import TOOLS

#: Loading Python takes seconds, and the machine may be busy.
LONG_MS = 100_000


def static_server(folder):
    """The server of `scripts/docs --serve` and `scripts/lesson --serve`."""
    path = TOOLS / "static_server.py"
    spec = importlib.util.spec_from_file_location("static_server", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    module.StaticPages.log_message = lambda *_: None
    return module.static_server(folder, 0)


class Host:
    """A static host, which can be switched off."""

    def __init__(self, folder):
        self._server = static_server(folder)
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
