"""One page of the graph: what it asks for, and what it does not have yet."""

from __future__ import annotations

import json
from collections.abc import Callable
from typing import Any, NamedTuple, Protocol

from turtlewire.web import CommandSession
from turtlewire.web.commands import CommandError, CommandReader
from turtlewire_view.graph.picture import TOPICS, Selection

__all__ = [
    "READER",
    "GraphHost",
    "GraphSession",
    "MeasureTopics",
    "ShowGraph",
]


class ShowGraph(NamedTuple):
    """Show a part of the graph; see :class:`turtlewire_view.graph.picture.Selection`."""

    topics: str
    debug: bool
    words: str


class MeasureTopics(NamedTuple):
    """Send the rates and values of these topics, and of no others."""

    topics: list[Any]


READER = CommandReader({"show": ShowGraph, "measure": MeasureTopics})

#: Each topic that is measured is a subscription, which the robot's network has to serve.
_MOST_TOPICS = 16


class GraphHost(Protocol):
    """The part of :class:`turtlewire_view.graph.graph_page.GraphPage` that a session needs."""

    selection: Selection

    def ask(self) -> None:
        """Wake the thread that draws and measures: a page asked for something else."""
        ...

    def forget(self, session: GraphSession) -> None:
        """Forget a page that was closed."""
        ...


class GraphSession(CommandSession):
    """The server's thread calls all methods but `show` and `show_readings`.

    Attributes:
        selection: What the page shows.
        topics: What it measures. Both are replaced, never changed: another thread reads them.
    """

    def __init__(self, host: GraphHost, name: str) -> None:
        super().__init__(READER)
        self._host = host
        self.selection = host.selection
        self.topics: frozenset[str] = frozenset()
        self._shown = self._sent = self._readings = self._sent_readings = ""
        self._actions: dict[type, Callable[[Any], None]] = {
            ShowGraph: self._select,
            MeasureTopics: self._measure,
        }
        self.answer({"type": "hello", "source": name, "selection": self.selection._asdict()})

    def show(self, message: str) -> None:
        """Take a graph; for any thread."""
        self._shown = message

    def show_readings(self, readings: dict[str, dict[str, Any]]) -> None:
        """Take the readings of all topics; for any thread."""
        own = {topic: reading for topic, reading in readings.items() if topic in self.topics}
        self._readings = json.dumps({"type": "readings", "topics": own})

    def news(self) -> list[str | bytes]:
        """Return what the page does not have yet."""
        news: list[str | bytes] = []
        shown, readings = self._shown, self._readings
        if shown != self._sent:
            self._sent = shown
            news.append(shown)
        if readings != self._sent_readings:
            self._sent_readings = readings
            news.append(readings)
        return news

    def obey(self, command: Any) -> None:
        """Carry out a command."""
        self._actions[type(command)](command)
        self._host.ask()

    def closed(self) -> None:
        """The page was closed."""
        self._host.forget(self)

    def _select(self, command: ShowGraph) -> None:
        if command.topics not in TOPICS:
            raise CommandError(f"topics must be one of {', '.join(TOPICS)}, not {command.topics!r}")
        self.selection = Selection(*command)

    def _measure(self, command: MeasureTopics) -> None:
        if not all(isinstance(each, str) and each.startswith("/") for each in command.topics):
            raise CommandError("topics must be a list of topic names")
        if len(command.topics) > _MOST_TOPICS:
            raise CommandError(f"A page measures at most {_MOST_TOPICS} topics.")
        self.topics = frozenset(command.topics)
