"""The page of the graph, for any number of browsers."""

from __future__ import annotations

import contextlib
import json
import os
import threading
from pathlib import Path
from types import TracebackType
from typing import TYPE_CHECKING, Any

from turtlewire.web import Server
from turtlewire.web.desktop import wanted_port
from turtlewire_view.graph.files import as_data
from turtlewire_view.graph.layout import make_diagram, make_layout
from turtlewire_view.graph.measuring import Measuring
from turtlewire_view.graph.picture import Selection, read_graph, select
from turtlewire_view.graph.session import GraphSession

if TYPE_CHECKING:
    from typing_extensions import Self

    from turtlewire.wire.base import Context
    from turtlewire_view.graph.picture import Picture

__all__ = ["GraphPage"]

_PAGE = Path(__file__).parent / "page"
#: Changes of the graph come in groups; this long the page waits for more.
_REST_S = 0.05
#: Between two readings of the topics that pages measure.
_READING_S = 1.0


class GraphPage:
    """Serves the page until it is closed.

    A second thread, next to the server's, draws the graph after each change and measures topics. It
    sleeps while nothing changes and no topic is measured.

    Args:
        context: The participant whose graph is shown.
        selection: What pages show first.
        port: Preferred TCP port; None follows turtlesim's rule (`TURTLEWIRE_PORT`, 7070).
        lan: Whether to serve all devices of the network (see :mod:`turtlewire.web.lan`).

    Attributes:
        url: The page's address.

    Raises:
        OSError: No port is free.
    """

    def __init__(
        self,
        context: Context,
        selection: Selection,
        *,
        port: int | None = None,
        lan: bool = False,
    ) -> None:
        self._context = context
        self.selection = selection
        self._lock = threading.Lock()
        self._sessions: list[GraphSession] = []
        self._asked, self._changed = threading.Event(), threading.Event()
        self._closing = threading.Event()
        self._drawn: tuple[Picture, dict[Selection, str]] | None = None
        self._ends = contextlib.ExitStack()
        # The name is one that tools leave out, so that the page does not show itself.
        name = f"_turtlewire_graph_{os.getpid()}"
        self._own_node = f"/{name}"
        node = context.create_node(name)
        self._ends.callback(node.close)
        self._measuring = Measuring(context.graph, node)
        self._ends.callback(self._measuring.close)
        self._ends.callback(context.graph.add_listener(self._take_change))
        try:
            self._server = Server(
                _PAGE, self._connect, port=wanted_port() if port is None else port, lan=lan
            )
        except BaseException:
            self._ends.close()
            raise
        self.url = self._server.url
        self._thread = threading.Thread(target=self._run, name="turtlewire-graph", daemon=True)
        self._thread.start()

    def ask(self) -> None:
        """Draw and measure what pages ask for now; for any thread."""
        self._asked.set()

    def forget(self, session: GraphSession) -> None:
        """Forget a page that was closed."""
        with self._lock:
            self._sessions.remove(session)
        self.ask()

    def close(self) -> None:
        """Close the pages' connections and all subscriptions. Idempotent."""
        if self._closing.is_set():
            return
        self._closing.set()
        self._asked.set()
        self._thread.join()
        self._server.close()
        self._ends.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()

    def _connect(self) -> GraphSession:
        session = GraphSession(self, f"ROS_DOMAIN_ID {self._context.domain_id}")
        with self._lock:
            self._sessions.append(session)
        self.ask()
        return session

    def _take_change(self) -> None:
        """On the wire's thread."""
        self._changed.set()
        self._asked.set()

    def _run(self) -> None:
        topics: set[str] = set()
        while not self._closing.is_set():
            self._asked.wait(_READING_S if topics else None)
            self._asked.clear()
            if self._changed.is_set():
                self._closing.wait(_REST_S)
                self._changed.clear()
                self._drawn = None
            with self._lock:
                sessions = list(self._sessions)
            topics = {topic for session in sessions for topic in session.topics}
            self._measuring.follow(topics)
            readings = self._measuring.readings()
            for session in sessions:
                session.show(self._message(session.selection))
                session.show_readings(readings)
            self._server.notify()

    def _message(self, selection: Selection) -> str:
        """Return the graph for a page; drawn once for all pages that show the same."""
        if self._drawn is None:
            graph, domain_id = self._context.graph, self._context.domain_id
            self._drawn = read_graph(graph, domain_id, self._own_node), {}
        picture, messages = self._drawn
        if selection not in messages:
            messages[selection] = _message(picture, selection)
        return messages[selection]


def _message(picture: Picture, selection: Selection) -> str:
    shown = select(picture, selection)
    diagram = make_diagram(shown, with_topics=selection.topics != "none")
    layout = make_layout(diagram)
    hidden = len(picture.nodes) - len(shown.nodes)
    message: dict[str, Any] = {
        "type": "graph",
        "boxes": [
            [*box, *(round(number, 1) for number in place[:4]), place.label]
            for box, place in zip(diagram.boxes, layout.boxes, strict=True)
        ],
        "arrows": [
            [*arrow, way.path, round(way.x), round(way.y)]
            for arrow, way in zip(diagram.arrows, layout.ways, strict=True)
        ],
        "width": round(layout.width),
        "height": round(layout.height),
        "hidden": hidden,
        "graph": as_data(picture, selection),
    }
    return json.dumps(message, separators=(",", ":"))
