"""Chooses the topics of a bag that are played."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from rosbag2_transport.topic_filter import EVENT_TOPIC, action_topic, is_service_event, pattern
from turtlewire.bag.metadata import is_decodable, not_in_cdr
from turtlewire.distro import KILTED, since
from turtlewire.terminal.suggestion import did_you_mean

if TYPE_CHECKING:
    from rosbag2_transport.options import PlayOptions
    from rosbag2_transport.played_bags import PlayedBags

_SECOND = 1_000_000_000


def played_topics(bag: PlayedBags, options: PlayOptions) -> list[str]:
    """Return the names of the topics to play, which must be decodable; patterns match whole names.

    As in rosbag2, names of topics do not hold back service events, nor the other way round.

    Raises:
        RuntimeError: A pattern is not a regular expression.
    """
    return [name for name in _selected(bag, options) if is_decodable(bag.topics[name])]


def _selected(bag: PlayedBags, options: PlayOptions) -> list[str]:
    """Return the names of the topics that the options leave."""
    regex, exclude = pattern(options.regex_to_filter), pattern(options.exclude_regex_to_filter)
    own_clock = options.clock_publish_frequency > 0 or options.clock_publish_on_topic_publish
    names = []
    for name, topic in bag.topics.items():
        action = action_topic(name, topic.type) if _knows_actions(options) else None
        plain_name = name if action is None else action.action
        if action is not None:
            listed, excluded = options.actions_to_filter, options.exclude_actions_to_filter
        elif is_service_event(name, topic.type):
            listed = options.services_to_filter
            excluded = options.exclude_service_events_to_filter
        else:
            listed, excluded = options.topics_to_filter, options.exclude_topics_to_filter
        if plain_name in excluded or (exclude and exclude.fullmatch(plain_name)):
            continue
        # The player's own time replaces the recorded one.
        if name == "/clock" and (own_clock or options.clock_trigger_topics):
            continue
        if regex:
            if regex.fullmatch(plain_name) or plain_name in listed:
                names.append(name)
        elif not listed or plain_name in listed:
            names.append(name)
    return names


def _knows_actions(options: PlayOptions) -> bool:
    """Return whether actions are played as such; in Jazzy, only if an option names them."""
    asked = (
        options.actions_to_filter,
        options.exclude_actions_to_filter,
        options.send_actions_as_client,
    )
    return since(KILTED) or any(asked)


def mistakes(bag: PlayedBags, options: PlayOptions) -> list[str]:
    """List what is not played although it was asked for; rosbag2 ignores it silently."""
    foreign = not_in_cdr((bag.topics[name] for name in _selected(bag, options)), "not played")
    return [
        *filter(None, [foreign]),
        *_unknown_topics(bag, options),
        *_unknown_services(bag, options),
        *_unknown_actions(bag, options),
    ] or [f"Nothing is played: {why}" for why in _emptiness(bag, options)]


def _unknown_topics(bag: PlayedBags, options: PlayOptions) -> Iterator[str]:
    named = (
        *options.topics_to_filter,
        *options.exclude_topics_to_filter,
        *options.clock_trigger_topics,
        *options.topic_qos_profile_overrides,
    )
    for name in dict.fromkeys(named):
        if name not in bag.topics:
            known = f"Its topics are {', '.join(sorted(bag.topics))}."
            yield f"The bag has no topic '{name}'. {did_you_mean(name, bag.topics) or known}"


def _unknown_services(bag: PlayedBags, options: PlayOptions) -> Iterator[str]:
    services = [
        name.removesuffix(EVENT_TOPIC)
        for name, topic in sorted(bag.topics.items())
        if is_service_event(name, topic.type)
    ]
    named = (*options.services_to_filter, *options.exclude_service_events_to_filter)
    for name in (each.removesuffix(EVENT_TOPIC) for each in dict.fromkeys(named)):
        if name not in services:
            known = (
                f"It has events of {', '.join(services)}." if services else "It has none at all."
            )
            hint = did_you_mean(name, services) or known
            yield f"The bag has no events of a service '{name}'. {hint}"


def _unknown_actions(bag: PlayedBags, options: PlayOptions) -> Iterator[str]:
    found = (action_topic(name, topic.type) for name, topic in bag.topics.items())
    actions = sorted({each.action for each in found if each is not None})
    named = (*options.actions_to_filter, *options.exclude_actions_to_filter)
    for name in dict.fromkeys(named):
        if name not in actions:
            known = f"Its actions are {', '.join(actions)}." if actions else "It has none at all."
            yield f"The bag has no action '{name}'. {did_you_mean(name, actions) or known}"


def _emptiness(bag: PlayedBags, options: PlayOptions) -> Iterator[str]:
    """Yield why nothing of a bag is played, if that is so."""
    lasts_ns = bag.end_ns - bag.start_ns
    if not bag.topics:
        yield "the bag is empty."
    elif not played_topics(bag, options):
        yield f"the options leave out all topics, which are {', '.join(sorted(bag.topics))}."
    elif options.start_offset * _SECOND > lasts_ns:
        yield f"the bag ends after {lasts_ns / _SECOND:g} s, before the start offset."
    elif 0 <= options.playback_until_timestamp < bag.start_ns and options.playback_duration < 0:
        yield f"the bag begins at {bag.start_ns} ns, after the time at which to end."
