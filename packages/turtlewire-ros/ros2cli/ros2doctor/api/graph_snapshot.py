"""The endpoints of the domain, discovered once for all parts of a report."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, NamedTuple

from ros2doctor.api.reporting import Report

if TYPE_CHECKING:
    from turtlewire.wire.base import EndpointInfo

#: Every node has them, including the one that asks.
SKIP_TOPICS = ["/parameter_events", "/rosout"]


class Counts(NamedTuple):
    """The numbers of endpoints of both kinds with a name.

    Attributes:
        name: Name of the topic, service or action.
        providers: Publishers or servers.
        users: Subscriptions or clients.
    """

    name: str
    providers: int
    users: int


class GraphSnapshot(NamedTuple):
    """The endpoints that were discovered.

    Attributes:
        topics: All topics except `SKIP_TOPICS`.
        services: All services.
        actions: All actions.
        endpoints: Publishers and subscriptions of the topics, by name of the topic.
    """

    topics: list[Counts]
    services: list[Counts]
    actions: list[Counts]
    endpoints: dict[str, list[EndpointInfo]]


#: The snapshot of each open `one_snapshot` block; None until it is first needed.
_shared: list[GraphSnapshot | None] = []


@contextmanager
def one_snapshot() -> Iterator[None]:
    """Let all calls of `snapshot` in the block return the same one."""
    _shared.append(None)
    try:
        yield
    finally:
        _shared.pop()


def snapshot() -> GraphSnapshot:
    """Return the endpoints of the graph now, or the result of the first call in the block."""
    if not _shared:
        return _discover()
    found = _shared[-1] or _discover()
    _shared[-1] = found
    return found


def list_report(title: str, labels: tuple[str, str, str], found: Iterable[Counts]) -> Report:
    """Return three lines for each name; one group of ``none`` and zeros without any."""
    report = Report(title)
    for counts in list(found) or [Counts("none", 0, 0)]:
        for label, value in zip(labels, counts, strict=True):
            report.add_to_report(label, value)
    return report


def _discover() -> GraphSnapshot:
    from ros2cli.discovery import discovered_graph
    from ros2cli.graph import actions, endpoints_of_topic, services, topics
    from turtlewire.wire.names import request_topic

    with discovered_graph() as graph:

        def ends(topic: str, kind: str) -> list[EndpointInfo]:
            return endpoints_of_topic(graph, topic, kind)

        named = [name for name, _ in topics(graph) if name not in SKIP_TOPICS]
        pairs = {name: (ends(name, "publisher"), ends(name, "subscription")) for name in named}
        return GraphSnapshot(
            [Counts(name, len(sent), len(taken)) for name, (sent, taken) in pairs.items()],
            [
                # A server reads the requests.
                Counts(name, len(ends(topic, "subscription")), len(ends(topic, "publisher")))
                for name, _ in services(graph)
                for topic in [request_topic(name)]
            ],
            [
                Counts(name, len(ends(topic, "publisher")), len(ends(topic, "subscription")))
                for name, _ in actions(graph)
                for topic in [f"{name}/_action/feedback"]
            ],
            {name: sent + taken for name, (sent, taken) in pairs.items()},
        )
