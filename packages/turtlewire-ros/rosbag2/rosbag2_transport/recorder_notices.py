"""Reports requested topics that cannot be recorded at the moment, and why.

rosbag2 waits in silence for topics that never appear.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from typing import TYPE_CHECKING

from rosbag2_transport.topic_filter import EVENT_TOPIC, action_topic, pattern
from turtlewire.terminal.suggestion import did_you_mean
from turtlewire.wire.names import is_hidden

if TYPE_CHECKING:
    from rosbag2_transport.options import RecordOptions
    from turtlewire.wire.base import Graph


def missing(options: RecordOptions, graph: Graph, recorded: Collection[str]) -> Iterator[str]:
    """Yield one text for each topic, service, type or pattern without a recorded topic.

    Args:
        options: Options of the recording.
        graph: What there is.
        recorded: Names of the topics that are recorded.
    """
    topics = graph.topic_names_and_types()
    if not options.all_topics:
        yield from _missing_topics(options, graph, recorded)
    if not options.all_services:
        services = graph.service_names_and_types()
        for name in dict.fromkeys(options.services):
            if name not in recorded:
                yield _why_no_events(name.removesuffix(EVENT_TOPIC), services)
    if not options.all_actions:
        for name in dict.fromkeys(options.actions):
            if not any(topic.startswith(f"{name}/_action/") for topic in recorded):
                yield _joined(
                    f"There is no action '{name}' yet.", did_you_mean(name, _actions(topics))
                )
    regex = pattern(options.regex)
    if regex and not any(regex.search(name.removesuffix(EVENT_TOPIC)) for name in recorded):
        yield f"No topic or service matches '{options.regex}' yet."


def _missing_topics(
    options: RecordOptions, graph: Graph, recorded: Collection[str]
) -> Iterator[str]:
    topics = graph.topic_names_and_types()
    patience = (
        "with --no-discovery the recorder does not look again"
        if options.is_discovery_disabled
        else "it is recorded from its first publisher on"
    )
    for name in dict.fromkeys(options.topics):
        if name not in recorded and len(topics.get(name, ())) < 2:  # two types: reported
            yield _why(options, name, _is_published(graph, name), topics, patience)
    for type_name in dict.fromkeys(options.topic_types):
        known = {each for types in topics.values() for each in types}
        if type_name not in known:
            hint = did_you_mean(type_name, known)
            yield _joined(f"No topic has the type '{type_name}' yet.", hint)


def _actions(topics: Mapping[str, list[str]]) -> set[str]:
    found = (action_topic(name, types[0]) for name, types in topics.items())
    return {each.action for each in found if each is not None}


def _is_published(graph: Graph, topic: str) -> bool:
    return bool(graph.endpoints_of(topic, "publisher"))


def _why(
    options: RecordOptions,
    name: str,
    published: bool,
    topics: Collection[str],
    patience: str,
) -> str:
    """Return why a topic that was named is not recorded."""
    if not published and not (options.include_unpublished_topics and name in topics):
        hint = "" if name in topics else did_you_mean(name, topics)
        return _joined(f"Topic '{name}' has no publisher; {patience}.", hint)
    if is_hidden(name) and not options.include_hidden_topics:
        return f"Topic '{name}' is hidden: give --include-hidden-topics to record it."
    if options.ignore_leaf_topics:
        return f"Topic '{name}' has no subscription, and --ignore-leaf-topics leaves it out."
    return f"Topic '{name}' is left out: the options name it and exclude it."


def _why_no_events(service: str, services: Collection[str]) -> str:
    if service in services:
        return (
            f"Service '{service}' publishes no events: switch its introspection on, in rclpy with "
            "configure_introspection()."
        )
    hint = did_you_mean(service, services)
    return _joined(f"There is no service '{service}' yet.", hint)


def _joined(text: str, hint: str) -> str:
    return f"{text} {hint}" if hint else text
