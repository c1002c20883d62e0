"""The view in the output of a notebook's cell: a frame of the page, which the kernel serves.

If the browser runs on the kernel's computer, page, WebSocket and files come from the kernel's own
address, so the checks of :mod:`turtlewire.web.origin` hold as in a tab. Otherwise the notebook
service passes requests on, and the address of the page has a token. Browsers enforce which pages
may embed it.
"""

from __future__ import annotations

import os
import sys
from html import escape
from importlib import import_module
from urllib.parse import urlsplit

__all__ = ["ColabFrame", "Frame", "ProxiedFrame", "find_frame"]

_HEIGHT = "540"
#: JupyterHub and Binder set it for each user's server, and kernels inherit it.
_HUB_VARIABLE = "JUPYTERHUB_SERVICE_PREFIX"
_SCHEMES = ("/", "https://", "http://")


class Frame:
    """A frame in a notebook of this computer, or of one that is reached through a tunnel.

    Attributes:
        proxied: True if the notebook service passes the requests on, under a name of its own.
        ancestors: The pages that may embed the view, for the Content-Security-Policy.
    """

    proxied = False
    #: Visual Studio Code shows outputs in a frame of its window, and browsers check each page
    #: around a frame.
    ancestors = (
        "http://localhost:* http://127.0.0.1:* https://localhost:* vscode-webview: vscode-file:"
    )

    def html(self, url: str) -> str:
        """Return the page at an address of this computer as an output of a cell.

        Below the page are a link to it and, for a notebook on another computer, the command that
        forwards its port, and the argument that replaces the command.
        """
        address, port = escape(url), urlsplit(url).port
        return (
            f'{_iframe(address)}<p><a href="{address}" target="_blank">{address}</a> Nothing to '
            "see? If the notebook runs on another computer, run "
            f"<code>ssh -L {port}:localhost:{port} COMPUTER</code>, or pass "
            '<code>proxy="/proxy/{port}/"</code> if its server has '
            "<code>jupyter-server-proxy</code>.</p>"
        )

    def display(self, url: str) -> None:
        """Show the page with a function of the notebook service.

        Raises:
            NotImplementedError: The service has no such function; show the HTML instead.
        """
        raise NotImplementedError


class ProxiedFrame(Frame):
    """A frame in a notebook whose server passes requests on to a port of the kernel's computer.

    Args:
        proxy: The path or address at which it does, such as ``/user/me/proxy/{port}/``.

    Raises:
        TypeError: ``proxy`` is not a string.
        ValueError: ``proxy`` has no ``{port}``, or does not start as a path or an address.
    """

    proxied = True
    ancestors = "'self'"  # server and proxy have the same origin

    def __init__(self, proxy: str) -> None:
        if not isinstance(proxy, str):
            raise TypeError(f"proxy must be str, not {type(proxy).__name__}")
        if "{port}" not in proxy or not proxy.startswith(_SCHEMES):
            raise ValueError(
                f"proxy is {proxy!r}; expected a path or an https address that contains {{port}}, "
                "such as '/proxy/{port}/'"
            )
        self._proxy = proxy

    def html(self, url: str) -> str:
        """Return the page as an output of a cell; the token is in it, but not in its text."""
        parts = urlsplit(url)
        below = self._proxy.replace("{port}", str(parts.port)).rstrip("/")
        address = escape(below + parts.path)
        return (
            f'{_iframe(address)}<p><a href="{address}" target="_blank">Open the view in a tab</a>. '
            "Nothing to see? The server of the notebook needs the package "
            "<code>jupyter-server-proxy</code>. The link lets others use the view while it runs: "
            "clear this output before you share the notebook.</p>"
        )


class ColabFrame(Frame):
    """A frame in Google Colab, which has a function for it."""

    proxied = True
    #: The output of a cell is a page at googleusercontent.com inside of the page of Colab.
    ancestors = (
        "https://colab.research.google.com https://*.googleusercontent.com https://*.colab.dev"
    )

    def html(self, url: str) -> str:
        """Return the advice to use `display`, because the browser cannot reach the address."""
        return (
            f"<p>The view is at port {urlsplit(url).port}. To see it, write it in the last line of "
            "a cell, or call <code>display(view)</code>.</p>"
        )

    def display(self, url: str) -> None:
        """Show the page in the output of the running cell."""
        parts = urlsplit(url)
        output = import_module("google.colab.output")
        output.serve_kernel_port_as_iframe(
            parts.port, path=parts.path, width="100%", height=_HEIGHT
        )


def find_frame(proxy: str | None) -> Frame | None:
    """Return the frame for the notebook that runs this program, or None if none does.

    Args:
        proxy: Where the notebook's server passes requests on, if the user named it.
    """
    if proxy is not None:
        return ProxiedFrame(proxy)
    if not _is_kernel():
        return None
    if "google.colab" in sys.modules:  # the kernels of Colab import it at their start
        return ColabFrame()
    prefix = os.environ.get(_HUB_VARIABLE)
    return Frame() if not prefix else ProxiedFrame(f"{prefix.rstrip('/')}/proxy/{{port}}/")


def _is_kernel() -> bool:
    ipython = sys.modules.get("IPython")
    return ipython is not None and hasattr(ipython.get_ipython(), "kernel")


def _iframe(address: str) -> str:
    return (
        f'<iframe src="{address}" title="turtlewire view" width="100%" height="{_HEIGHT}" '
        'style="border: 0"></iframe>'
    )
