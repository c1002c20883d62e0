"""A small HTTP and WebSocket server for this machine's browsers: files and live values.

=============  =================================================================
module         what it holds
=============  =================================================================
`server`       `Server`: one thread for the pages and WebSockets of all browsers
`connections`  the sockets of a server, and its end
`files`        what a page consists of: files, media types, headers
`encoding`     files as they are sent: compressed, or status 304
`desktop`      where a page is shown: browser and port
`origin`       which requests are answered
`options`      options of commands that serve a page
`lan`          a page for other devices: token, addresses, QR code
=============  =================================================================
"""

from __future__ import annotations

from turtlewire.web.files import Content
from turtlewire.web.server import PageSession, Server

__all__ = ["Content", "PageSession", "Server"]
