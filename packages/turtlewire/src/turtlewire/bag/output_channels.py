"""The topics and channels of a bag that is made from others: names, types, definitions, QoS."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from fnmatch import fnmatchcase
from typing import TYPE_CHECKING

from turtlewire.bag.message import channel_of
from turtlewire.bag.metadata import NEWEST_VERSION, full_type_name
from turtlewire.bag.qos_yaml import profiles_to_text
from turtlewire.errors import BagError
from turtlewire.terminal.suggestion import did_you_mean
from turtlewire.wire.names import validate_full_topic_name

if TYPE_CHECKING:
    from turtlewire.bag.message import BagChannel, BagMessage
    from turtlewire.bag.metadata import TopicInfo
    from turtlewire.bag.reader import Bag

__all__ = [
    "OutputChannels",
    "Selection",
    "as_tuple",
]

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


#: Topic, type, encodings and definition: messages of one key go to one channel.
_Key = tuple[str, str, str, str, bytes]


@dataclass
class _Source:
    channel: BagChannel
    bag: str


class OutputChannels:
    """The channels of the bag to write, from the selected topics of other bags.

    A topic has several channels if its messages follow several definitions.

    Args:
        bags: The bags that are read.
        selection: The topics and their new names.
        storage: Storage of the bag to write.

    Attributes:
        channels: The channels by the name that `BagWriter.add_channel` gets.

    Raises:
        BagError: A topic has two types, or sqlite3 has no room for two definitions of a type.
    """

    def __init__(self, bags: Sequence[Bag], selection: Selection, storage: str) -> None:
        self._selection = selection
        #: A sqlite3 file has one definition of each type, which `_check_definition` compares.
        self._has_one_definition = storage == "sqlite3"
        self._definitions: dict[str, _Source] = {}
        self._names: dict[_Key, str] = {}
        self._names_of_kinds: dict[type[BagMessage], str] = {}
        self._sources: dict[str, _Source] = {}
        for bag in bags:
            for file in bag.readable_files(bag.metadata.paths, []):
                for channel in file.channels():
                    if selection.takes(channel.topic):
                        self._add(_completed(channel, bag), bag.path)
        self.channels = {name: source.channel for name, source in self._sources.items()}

    def name_of(self, channel: BagChannel) -> str:
        """Return the name of the channel that the messages of another bag's channel go to."""
        return self._names[self._key(channel)]

    def name_of_message(self, message: BagMessage) -> str:
        """Return the name of the channel that a message goes to."""
        kind = type(message)
        name = self._names_of_kinds.get(kind)
        if name is None:
            name = self._names_of_kinds[kind] = self.name_of(channel_of(kind))
        return name

    def is_same(self, channel: BagChannel) -> bool:
        """Return True if a channel of an MCAP file is written as it is, numbers included."""
        own = self.channels[self.name_of(channel)]
        return (
            channel.record is not None
            and channel.record == own.record
            and channel.schema == own.schema
        )

    def _key(self, channel: BagChannel) -> _Key:
        topic, schema = channel.topic, channel.schema
        name = self._selection.new_name(topic.name)
        kind = f"{topic.serialization_format} {schema.encoding}"
        if self._has_one_definition:
            return name, topic.type, topic.serialization_format, "", b""
        return name, topic.type, kind, schema.name, schema.data

    def _add(self, channel: BagChannel, bag: str) -> None:
        key = self._key(channel)
        topic = key[0]
        if self._has_one_definition and channel.schema.data:
            self._check_definition(_Source(channel, bag))
        known = self._names.get(key)
        if known is not None:
            source = self._sources[known]
            source.channel = _with_qos(source.channel, channel)
            return
        self._check_type(topic, channel.topic.type, bag)
        # A line feed is in no name of a topic.
        number = sum(each[0] == topic for each in self._names)
        name = f"{topic}\n{number}" if number else topic
        self._names[key] = name
        self._sources[name] = _Source(_renamed(channel, topic), bag)

    def _check_type(self, topic: str, type_name: str, bag: str) -> None:
        first = self._sources.get(topic)
        if first is None or first.channel.topic.type == type_name:
            return
        raise BagError(
            f"{topic} is of type {first.channel.topic.type} in {first.bag}, and of type "
            f"{type_name} in {bag}"
        ).with_hint("Leave one of them out, or give one another name.")

    def _check_definition(self, source: _Source) -> None:
        type_name = source.channel.topic.type
        first = self._definitions.setdefault(type_name, source)
        if first.channel.schema.data != source.channel.schema.data:
            raise BagError(
                f"{type_name} is defined differently in {first.bag} and {source.bag}, and a "
                "sqlite3 bag has one definition of a type"
            ).with_hint("Write an MCAP bag, which keeps both.")


def _completed(channel: BagChannel, bag: Bag) -> BagChannel:
    """Return a channel with the QoS and hash of ``metadata.yaml``, if its file has none."""
    topic, known = channel.topic, bag.topics.get(channel.topic.name)
    if known is None or (topic.qos and topic.type_hash):
        return channel
    qos, type_hash = topic.qos or known.qos, topic.type_hash or known.type_hash
    return replace(channel, topic=replace(topic, qos=qos, type_hash=type_hash))


def _renamed(channel: BagChannel, name: str) -> BagChannel:
    if name == channel.topic.name:
        return channel
    record = channel.record and replace(channel.record, topic=name)
    return replace(channel, topic=replace(channel.topic, name=name), record=record)


def _with_qos(channel: BagChannel, other: BagChannel) -> BagChannel:
    """Return a channel with the QoS of the publishers of both."""
    added = [qos for qos in other.topic.qos if qos not in channel.topic.qos]
    if not added:
        return channel
    topic = replace(channel.topic, qos=[*channel.topic.qos, *added])
    record = channel.record
    if record is not None:
        text = profiles_to_text(topic.qos, NEWEST_VERSION)
        record = replace(record, metadata={**record.metadata, "offered_qos_profiles": text})
    return replace(channel, topic=topic, record=record)
