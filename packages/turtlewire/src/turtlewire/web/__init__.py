"""A small HTTP and WebSocket server for this machine's browsers: files and live values.

===============  ===================================================================
module           contents
===============  ===================================================================
`server`         `Server`: the pages and WebSockets of all browsers
`server_thread`  the thread of a server, also of Foxglove's, and its shutdown
`loop_calls`     calls from other threads to that thread
`commands`       `CommandSession`; the commands of a page: JSON, checked and converted
`packets`        binary messages to a page: a header and arrays as bytes
`files`          the files of a page as responses: media types, headers, compression
`desktop`        the browser and the port of a page; their options
`origin`         rejects requests of other sites
`lan`            a page for other devices: token, addresses, QR code
===============  ===================================================================

The folder ``kit`` holds the common parts of the pages: palette and base style, the connection, the
switch of the letter keys. `Server` serves it below ``/kit/``, and the lesson has a copy.
"""

from turtlewire.web.commands import CommandSession, PageSession
from turtlewire.web.files import WebContent
from turtlewire.web.server import Server

__all__ = ["CommandSession", "PageSession", "Server", "WebContent"]
