"""Which topics of a bag are played."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rosbag2_transport.topic_filter import is_service_event, pattern

if TYPE_CHECKING:
    from rosbag2_transport.options import PlayOptions
    from turtlewire.bag import Bag

__all__ = ["played_topics"]


def played_topics(bag: Bag, options: PlayOptions) -> list[str]:
    """Names of the topics to play; patterns match whole names.

    As in rosbag2, names of topics do not hold back service events, nor the other way round.

    Raises:
        RuntimeError: A pattern is no regular expression.
    """
    regex, exclude = pattern(options.regex_to_filter), pattern(options.exclude_regex_to_filter)
    own_clock = options.clock_publish_frequency > 0 or options.clock_publish_on_topic_publish
    names = []
    for name, topic in bag.topics.items():
        if is_service_event(name, topic.type):
            listed = options.services_to_filter
            excluded = options.exclude_service_events_to_filter
        else:
            listed, excluded = options.topics_to_filter, options.exclude_topics_to_filter
        if name in excluded or (exclude and exclude.fullmatch(name)):
            continue
        if name == "/clock" and (own_clock or options.clock_trigger_topics):
            continue
        if regex:
            if regex.fullmatch(name) or name in listed:
                names.append(name)
        elif not listed or name in listed:
            names.append(name)
    return names
