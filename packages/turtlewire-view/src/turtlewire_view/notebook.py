"""The view in the output of a notebook's cell: an iframe of the page, which the kernel serves.

The page, its WebSocket and its files come from the kernel's own address, so the checks of
:mod:`turtlewire.web.origin` hold as in a tab. Browsers enforce which pages may embed it.
"""

from __future__ import annotations

import sys
from html import escape
from urllib.parse import urlsplit

__all__ = ["EMBEDDING", "is_notebook", "view_html"]

#: Notebooks are served by this computer, or reached through a tunnel to it. Visual Studio Code
#: shows outputs in a frame of its window, and browsers check each page around a frame.
EMBEDDING = {
    "frame-ancestors": "http://localhost:* http://127.0.0.1:* https://localhost:* "
    "vscode-webview: vscode-file:"
}
_NOT_IN_COLAB = (
    "<p>Colab runs this notebook on another computer, and the 3D view answers only the computer "
    "that runs it. Open the notebook in a Jupyter on your computer. The other outputs of "
    "turtlewire, such as the tree of a buffer, need no server.</p>"
)


def is_notebook() -> bool:
    """Return True in a kernel, which shows the page in the output of a cell."""
    ipython = sys.modules.get("IPython")
    return ipython is not None and hasattr(ipython.get_ipython(), "kernel")


def view_html(url: str) -> str:
    """Return the page at an address as an output of a cell.

    Below the page are a link to it and, for a notebook on another computer, the command that
    forwards its port.
    """
    if "google.colab" in sys.modules:
        return _NOT_IN_COLAB
    address, port = escape(url), urlsplit(url).port
    return (
        f'<iframe src="{address}" title="turtlewire view" width="100%" height="540" '
        'style="border: 0"></iframe>'
        f'<p><a href="{address}" target="_blank">{address}</a> Nothing to see? If the notebook '
        f"runs on another computer, run <code>ssh -L {port}:localhost:{port} COMPUTER</code>.</p>"
    )
