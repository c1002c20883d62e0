"""The view: a page for any number of browsers, with data from one source."""

from __future__ import annotations

import contextlib
import threading
from dataclasses import replace
from pathlib import Path
from types import TracebackType
from typing import TYPE_CHECKING, Any

from turtlewire.web import Server
from turtlewire.web.commands import CommandError
from turtlewire.web.desktop import wanted_port
from turtlewire.web.packets import encode_packet
from turtlewire_view.display_feed import DisplayFeed
from turtlewire_view.displays import display_for, displays_of, further_kinds
from turtlewire_view.displays.options import OptionError
from turtlewire_view.meshes import MeshLibrary
from turtlewire_view.notebook import Frame
from turtlewire_view.package_folders import PackageFolders
from turtlewire_view.session import ViewSession

if TYPE_CHECKING:
    from typing_extensions import Self

    from turtlewire_view.rviz_file import SavedView
    from turtlewire_view.source import Source

__all__ = ["Viewer"]

_PAGE = Path(__file__).parent / "page"
#: Shortest time between pictures, and the time if nothing changes but the ages [s].
_FRAME_S, _IDLE_S = 1 / 30, 1.0
_MOST_DOCUMENTS = 16


#: GLTF files may hold their pictures and numbers themselves.
_SOURCES = {"connect-src": "data: blob:"}


class Viewer:
    """Serves the page until it is closed.

    Two threads in addition to the server's: one notifies the pages of changes up to 30 times a
    second, one makes geometry of messages.

    Args:
        source: Where frames and messages come from; closed with the view.
        fixed_frame: What pages look from first; empty takes the root of the largest tree.
        port: Preferred TCP port; None uses turtlesim's rule (`TURTLEWIRE_PORT`, 7070).
        saved: What pages show first, of a ``.rviz`` file.
        lan: Whether to serve all devices of the network (see :mod:`turtlewire.web.lan`).
        frame: The frame of a notebook that may embed the page.
        packages: Where packages with meshes lie; None uses the ament index.

    Attributes:
        url: The page's address.
        documents: The files that pages have loaded, by their tokens.

    Raises:
        OSError: No port is free.
    """

    def __init__(
        self,
        source: Source,
        fixed_frame: str = "",
        *,
        port: int | None = None,
        lan: bool = False,
        saved: SavedView | None = None,
        frame: Frame | None = None,
        packages: PackageFolders | None = None,
    ) -> None:
        self.source = source
        self.fixed_frame = fixed_frame
        self._lock = threading.Lock()
        self._sessions: list[ViewSession] = []
        self._changed, self._work = threading.Event(), threading.Event()
        self._closing = threading.Event()
        self._meshes = MeshLibrary()
        self._frame = frame
        self._packages = packages or PackageFolders()
        if saved is not None and fixed_frame:
            saved = replace(saved, fixed=fixed_frame)
        self._saved = saved
        self.documents: dict[str, SavedView] = {}
        if saved is not None:
            self.keep_document(saved)
        self._server = Server(
            _PAGE,
            self._connect,
            port=wanted_port() if port is None else port,
            lan=lan,
            proxied=frame is not None and frame.proxied,
            answer=self._meshes.answer,
            immutable="/vendor/",
            sources=_SOURCES | ({} if frame is None else {"frame-ancestors": frame.ancestors}),
        )
        self.url = self._server.url
        self._threads = [
            threading.Thread(target=run, name=f"turtlewire-view-{name}", daemon=True)
            for name, run in (("pace", self._pace), ("displays", self._make_displays))
        ]
        for thread in self._threads:
            thread.start()
        source.on_change(self._take_change)

    def wait(self) -> None:
        """Wait until the view is closed or Ctrl-C is pressed."""
        with contextlib.suppress(KeyboardInterrupt):
            self._closing.wait()

    def close(self) -> None:
        """Close the pages' connections and the source. Idempotent."""
        if self._closing.is_set():
            return
        self._closing.set()
        self._changed.set()
        self._work.set()
        for thread in self._threads:
            thread.join()
        self._server.close()
        self.source.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()

    def _repr_html_(self) -> str:
        """Return the page for the output of a notebook's cell."""
        return (self._frame or Frame()).html(self.url)

    def _ipython_display_(self) -> None:
        """Show the page with a function of the notebook service.

        Raises:
            NotImplementedError: The notebook has no such function; IPython then uses the HTML.
        """
        (self._frame or Frame()).display(self.url)

    def hello(self) -> bytes:
        """Return the first packet of a page."""
        return encode_packet(
            {"type": "hello", "source": {"kind": self.source.kind, "name": self.source.name}}
        )

    def first_view(self) -> list[bytes]:
        """Return the packets of a page's first view, if a file defines one."""
        if self._saved is None:
            return []
        return [encode_packet({**self._saved.header(), "first": True})]

    def keep_document(self, view: SavedView) -> None:
        """Remember a file that was loaded, and a few before it."""
        self.documents[view.token] = view
        while len(self.documents) > _MOST_DOCUMENTS:
            del self.documents[next(iter(self.documents))]

    def topics(self) -> list[dict[str, Any]]:
        """Return the topics, each with the kind of display that shows it, or None.

        ``others`` are the kinds that the user may choose instead.
        """
        topics = self.source.topics()
        names = {topic.name for topic in topics}
        return [
            {
                **topic._asdict(),
                "kind": each.kind if (each := display_for(*topic[:2])) else None,
                "others": further_kinds(topic.name, topic.type_name, names),
            }
            for topic in topics
        ]

    def new_feed(self, name: str, kind: str, topic: str, options: dict[str, object]) -> DisplayFeed:
        """Subscribe for a display.

        Raises:
            CommandError: The display or topic does not exist, or an option is invalid.
            WireError: The topic cannot be subscribed.
        """
        topics = sorted(self.source.topics(), key=lambda each: each.publishers)
        types_there = {each.name: each.type_name for each in topics}  # what is published counts
        of_kind = displays_of(kind)
        asked = options.get("message_type")  # a file names it before the topic exists
        if not isinstance(asked, str) or asked not in of_kind:
            asked = next(iter(of_kind), "")
        type_name = types_there.get(topic) or asked
        if type_name not in of_kind or not (topic or kind == "robot_model"):
            raise CommandError(f"No display {kind!r} shows {topic} of type {type_name or '?'}.")
        display_type = of_kind[type_name]
        try:
            display = display_type(options)
        except OptionError as error:
            raise CommandError(f"{topic or kind} is not shown: {error}.") from error
        display.packages, display.topic = self._packages, topic
        types = display.topics(type_name)
        feed = DisplayFeed(name, display, types, lambda _: self._work.set(), self._changed.set)
        feed.on_packages = self._meshes.permit
        feed.ask = self.source.ask_parameter
        try:
            self._connect_feed(feed)
        except BaseException:  # such as the WireError of the second topic's invalid name
            feed.close()
            raise
        return feed

    def _connect_feed(self, feed: DisplayFeed) -> None:
        """Connect a display with its topics, the parameter and the service that it needs."""
        if feed.display.sends is not None:
            self.source.advertise(*feed.display.sends)
        for topic, type_name in feed.types.items():
            feed.ends.append(self.source.subscribe(topic, type_name, _sink(feed, topic)))
        feed.follow_parameter()
        feed.call_service(self.source.ask_service)

    def work(self) -> None:
        """Wake the thread that updates the displays; it finds the pages that need new poses."""
        self._work.set()

    def forget(self, session: ViewSession) -> None:
        """Forget a page that was closed."""
        with self._lock:
            self._sessions.remove(session)

    def _connect(self) -> ViewSession:
        session = ViewSession(self)
        with self._lock:
            self._sessions.append(session)
        return session

    def _take_change(self) -> None:
        self._changed.set()
        self._work.set()

    def _pace(self) -> None:
        while not self._closing.is_set():
            self._changed.wait(_IDLE_S)
            self._changed.clear()
            self._server.notify()
            self._closing.wait(_FRAME_S)

    def _make_displays(self) -> None:
        while not self._closing.is_set():
            self._work.wait()
            self._work.clear()
            self._work_for_all()

    def _work_for_all(self) -> None:
        """Update all pages. A separate method, so that no local keeps closed pages alive."""
        with self._lock:
            sessions = list(self._sessions)
        for session in sessions:
            for feed in session.feeds:
                feed.work(session.base)


def _sink(feed: DisplayFeed, topic: str) -> Any:
    return lambda cdr: feed.take_message(topic, cdr)
