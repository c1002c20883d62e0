"""Selects the topics that go into a new bag, and renames them."""

from __future__ import annotations

from dataclasses import dataclass, field
from fnmatch import fnmatchcase
from typing import TYPE_CHECKING

from turtlewire.bag.metadata import full_type_name
from turtlewire.errors import BagError
from turtlewire.terminal.suggestion import did_you_mean
from turtlewire.wire.names import validate_full_topic_name

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence

    from turtlewire.bag.metadata import TopicInfo
    from turtlewire.bag.reader import Bag

__all__ = ["Selection", "as_tuple"]

_MOST_NAMES = 20


@dataclass(frozen=True)
class Selection:
    """Topics by name and type, and their new names.

    Attributes:
        topics: Names, or patterns such as ``/camera/*``; empty for all topics.
        exclude: Names or patterns of topics that are left out.
        types: Names of types, or patterns such as ``sensor_msgs/*``; empty for all types.
        renames: New names by old name.
    """

    topics: Sequence[str] = ()
    exclude: Sequence[str] = ()
    types: Sequence[str] = ()
    renames: Mapping[str, str] = field(default_factory=dict)

    def check(self, bags: Sequence[Bag]) -> None:
        """Refuse names that none of the bags has.

        Raises:
            BagError: A name or pattern fits nothing, or a new name is not the name of a topic.
        """
        topics = {name for bag in bags for name in bag.topics}
        types = {topic.type for bag in bags for topic in bag.metadata.topics}
        for pattern in (*self.topics, *self.exclude):
            _check_known("topic", pattern, topics)
        for pattern in self.types:
            _check_known("type", full_type_name(pattern), types)
        chosen = {topic.name for bag in bags for topic in bag.metadata.topics if self.takes(topic)}
        if not chosen:
            raise BagError("the selection has no topic").with_hint(_listed("topic", topics))
        for old, new in self.renames.items():
            _check_known("topic", old, chosen, patterns=False)
            if fault := validate_full_topic_name(new):
                raise BagError(f"'{new}' is not the name of a topic: {fault.message}")

    def takes(self, topic: TopicInfo) -> bool:
        """Return True if the messages of a topic are selected."""
        return (
            (not self.topics or _fits(topic.name, self.topics))
            and (not self.types or _fits(topic.type, map(full_type_name, self.types)))
            and not _fits(topic.name, self.exclude)
        )

    def new_name(self, topic: str) -> str:
        """Return the name that a topic gets."""
        return self.renames.get(topic, topic)


def as_tuple(names: str | Iterable[str]) -> tuple[str, ...]:
    """Return one name or several as a tuple."""
    return (names,) if isinstance(names, str) else tuple(names)


def _fits(name: str, patterns: Iterable[str]) -> bool:
    return any(name == pattern or fnmatchcase(name, pattern) for pattern in patterns)


def _check_known(kind: str, name: str, known: set[str], *, patterns: bool = True) -> None:
    """Refuse a name or pattern that fits none of the known names."""
    if name in known or (patterns and any(fnmatchcase(each, name) for each in known)):
        return
    hint = did_you_mean(name, known) or _listed(kind, known)
    raise BagError(f"there is no {kind} '{name}' in the bag").with_hint(hint)


def _listed(kind: str, known: set[str]) -> str:
    if not known:
        return f"There is no {kind} at all."
    names = sorted(known)
    more = f" and {len(names) - _MOST_NAMES} more" if len(names) > _MOST_NAMES else ""
    return f"There are the {kind}s {', '.join(names[:_MOST_NAMES])}{more}."
