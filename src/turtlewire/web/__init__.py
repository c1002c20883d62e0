"""A small HTTP and WebSocket server for this machine's browsers: files and live values.

=========  =================================================================
module     what it holds
=========  =================================================================
`server`   `Server`: one thread for the pages and WebSockets of all browsers
`files`    the static files of a page
`desktop`  where a page is shown: browser and port
`origin`   which requests are answered
=========  =================================================================
"""

from __future__ import annotations

from turtlewire.web.server import Server, Session

__all__ = ["Server", "Session"]
