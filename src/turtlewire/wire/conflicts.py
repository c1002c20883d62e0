"""Mistakes that the graph shows: two types on one topic, and two nodes of one name."""

from __future__ import annotations

from collections import Counter
from typing import TYPE_CHECKING

from .report import warn_once

if TYPE_CHECKING:
    from collections.abc import Iterable

__all__ = ["NodeNames", "TopicTypes"]

_OTHER = {"publisher": "subscription", "subscription": "publisher"}
_VERB = {"publisher": "publishes", "subscription": "subscribes to"}


class TopicTypes:
    """Warns once of a topic where this process and a peer use different types.

    DDS matches endpoints by topic and type, so such a pair is silent.
    """

    def __init__(self) -> None:
        self._all: dict[str, Counter[tuple[str, str]]] = {}
        self._own: dict[str, Counter[tuple[str, str]]] = {}

    def add(self, topic: str, kind: str, type_name: str, *, own: bool) -> None:
        """Count an endpoint; the topic is a full ROS name, kind is publisher or subscription."""
        known = self._all.setdefault(topic, Counter())
        known[kind, type_name] += 1
        if own:
            self._own.setdefault(topic, Counter())[kind, type_name] += 1
        if len(known) > 1 and topic in self._own:
            self._compare(topic)

    def _compare(self, topic: str) -> None:
        for kind, type_name in self._own[topic]:
            others = {other for kind_, other in self._all[topic] if kind_ == _OTHER[kind]}
            if others and type_name not in others:
                warn_once(
                    f"types {topic} {kind}",
                    f"topic {topic} has the type {' and '.join(sorted(others))}, but this process "
                    f"{_VERB[kind]} {type_name}: no messages get through. "
                    "Use the topic's type, or another topic name.",
                )

    def remove(self, topic: str, kind: str, type_name: str, *, own: bool) -> None:
        """Undo :meth:`add`."""
        for counters in (self._all, self._own) if own else (self._all,):
            counter = counters[topic]
            counter[kind, type_name] -= 1
            if not counter[kind, type_name]:
                del counter[kind, type_name]
            if not counter:
                del counters[topic]


class NodeNames:
    """Warns once of each node of this process whose name another process has taken as well.

    Args:
        domain_id: The domain that both are in.
    """

    def __init__(self, domain_id: int) -> None:
        self._domain_id = domain_id
        self._others: dict[bytes, frozenset[str]] = {}

    def others(self, participant: bytes, nodes: Iterable[str], own: Iterable[str]) -> None:
        """Take over the full names of another participant's nodes, and compare them with ours."""
        self._others[participant] = frozenset(nodes)
        for name in self._others[participant].intersection(own):
            self._warn(name)

    def gone(self, participant: bytes) -> None:
        """Another participant has left."""
        self._others.pop(participant, None)

    def own(self, name: str) -> None:
        """Compare the full name of a new node of ours."""
        if any(name in nodes for nodes in self._others.values()):
            self._warn(name)

    def _warn(self, name: str) -> None:
        if name.rpartition("/")[2].startswith("_"):
            return  # tools leave it out, and it offers nothing
        warn_once(
            f"node {name}",
            f"another process has a node {name} in domain {self._domain_id}, too: what is sent to "
            "one reaches both. Run one of them in another domain (ROS_DOMAIN_ID=7), or under "
            "another name (--ros-args -r __node:=NAME). A process that was killed counts for 10 s.",
        )
