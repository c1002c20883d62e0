"""The commands of the page, see :mod:`turtlewire.web.commands`."""

from __future__ import annotations

from typing import Any, NamedTuple

from turtlewire.web.commands import CommandReader

__all__ = ["READER", "MeasureTopics", "ShowGraph"]


class ShowGraph(NamedTuple):
    """Show a part of the graph; see :class:`turtlewire_view.graph.selection.Selection`."""

    topics: str
    debug: bool
    words: str


class MeasureTopics(NamedTuple):
    """Send the rates and values of these topics, and of no others."""

    topics: list[Any]


READER = CommandReader({"show": ShowGraph, "measure": MeasureTopics})
