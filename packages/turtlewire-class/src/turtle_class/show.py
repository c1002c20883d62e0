"""The page of the class: a card for each student."""

from __future__ import annotations

import contextlib
import json
import sys
import threading
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import TYPE_CHECKING

from turtle_class.domain_watch import DomainWatch
from turtlewire.web import Server
from turtlewire.web.desktop import wanted_port

if TYPE_CHECKING:
    from turtle_class.roster import Seat

__all__ = ["ClassPage"]

_PAGE = Path(__file__).parent / "page"
#: Pictures a second, and how many of them look at the frames.
_PERIOD_S, _FRESH_EACH = 0.2, 5
#: How long the doctor listens to a domain; it goes from one to the next while a page is open.
_LISTEN_S, _PAUSE_S = 1.0, 0.2
_FILES = 8192


class ClassPage:
    """Watches the domains and serves the page until it is closed.

    Args:
        seats: The students.
        port: Preferred TCP port; None uses turtlesim's rule (``TURTLEWIRE_PORT``, 7070).
        lan: Whether to serve all devices of the network.

    Attributes:
        url: The page's address.

    Raises:
        WireError: A domain cannot be joined.
        OSError: No port is free.
    """

    def __init__(
        self, seats: Sequence[Seat], *, port: int | None = None, lan: bool = False
    ) -> None:
        _allow_many_files()
        self._closing = threading.Event()
        self._text = json.dumps({"type": "seats", "seats": []})
        self._number = 0
        with contextlib.ExitStack() as stack:
            self._watches: list[DomainWatch] = []
            for seat in seats:
                watch = DomainWatch(seat)
                stack.callback(watch.close)
                self._watches.append(watch)
            self._server = Server(
                _PAGE, self._connect, port=wanted_port() if port is None else port, lan=lan
            )
            self.url = self._server.url
            stack.pop_all()
        self._threads = [
            threading.Thread(target=run, name=f"turtlewire-class-{name}", daemon=True)
            for name, run in (("pictures", self._paint), ("doctor", self._examine))
        ]
        for thread in self._threads:
            thread.start()

    def close(self) -> None:
        """Close the pages' connections and leave the domains."""
        self._closing.set()
        for thread in self._threads:
            thread.join()
        self._server.close()
        with ThreadPoolExecutor(len(self._watches)) as pool:  # a session of Zenoh takes a while
            for watch in self._watches:
                pool.submit(watch.close)

    def latest(self) -> tuple[int, str]:
        """Number and text of the newest picture."""
        return self._number, self._text

    def _connect(self) -> _Session:
        return _Session(self)

    def _paint(self) -> None:
        count = 0
        while not self._closing.wait(_PERIOD_S):
            if not self._server.watched:
                for watch in self._watches:
                    watch.rest()
                continue
            fresh = count % _FRESH_EACH == 0
            count += 1
            seats = [watch.picture(fresh=fresh) for watch in self._watches]
            self._text = json.dumps({"type": "seats", "seats": seats}, separators=(",", ":"))
            self._number += 1
            self._server.notify()

    def _examine(self) -> None:
        while not self._closing.wait(_PAUSE_S):
            for watch in self._watches:
                if self._closing.is_set() or not self._server.watched:
                    break
                watch.examine(self._closing, _LISTEN_S)


def _allow_many_files() -> None:
    """Raise the limit of open files: thirty domains need 2000 with Zenoh, 200 with Cyclone DDS."""
    if sys.platform != "win32":
        import resource

        soft, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
        if soft != resource.RLIM_INFINITY and (hard == resource.RLIM_INFINITY or hard > soft):
            wanted = _FILES if hard == resource.RLIM_INFINITY else min(hard, _FILES)
            resource.setrlimit(resource.RLIMIT_NOFILE, (max(soft, wanted), hard))


class _Session:
    """A browser: it gets the newest picture when it has taken the last one."""

    def __init__(self, page: ClassPage) -> None:
        self._page = page
        self._sent = 0

    def outgoing(self) -> list[str | bytes]:
        number, text = self._page.latest()
        if number == self._sent:
            return []
        self._sent = number
        return [text]

    def receive(self, message: str | bytes) -> None:
        """Ignore the message: this page sends no commands."""

    def closed(self) -> None:
        """Nothing is kept for a browser."""
