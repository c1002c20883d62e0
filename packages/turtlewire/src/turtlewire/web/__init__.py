"""A small HTTP and WebSocket server for this machine's browsers: files and live values.

===============  ===================================================================
module           what it holds
===============  ===================================================================
`server`         `Server`: the pages and WebSockets of all browsers
`server_thread`  the thread of a server, here and of Foxglove's; how it ends in time
`loop_calls`     calls of other threads on that thread
`sessions`       `PageSession` and what sessions share: errors are answered
`commands`       what a page may send: JSON, checked and turned into tuples
`packets`        what a page gets beside JSON: a header and arrays as bytes
`files`          what a page consists of: files, media types, headers
`encoding`       files as they are sent: compressed, or status 304
`desktop`        where a page is shown: browser and port
`origin`         which requests are answered
`options`        options of commands that serve a page
`lan`            a page for other devices: token, addresses, QR code
===============  ===================================================================

The folder ``kit`` holds what the pages share: palette and base style, the connection, the switch of
the letter keys. `Server` serves it below ``/kit/``, and the lesson has a copy.
"""

from __future__ import annotations

from turtlewire.web.files import WebContent
from turtlewire.web.server import Server
from turtlewire.web.sessions import CommandSession, PageSession

__all__ = ["CommandSession", "PageSession", "Server", "WebContent"]
