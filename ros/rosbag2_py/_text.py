"""The text of ``ros2 bag info``."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Mapping

    from rosbag2_py._storage import BagMetadata, TopicInformation

__all__ = ["info", "is_service_event", "service_of"]

_EVENT_TOPIC, _EVENT_TYPE = "/_service_event", "_Event"
_UNITS = ("B", "KiB", "MiB", "GiB", "TiB")
_LABEL_WIDTH, _SERVICE_WIDTH = 19, 21


def is_service_event(topic: str, type_name: str) -> bool:
    """Whether a topic carries the introspection events of a service."""
    return topic.endswith(_EVENT_TOPIC) and type_name.endswith(_EVENT_TYPE)


def service_of(topic: str, type_name: str) -> tuple[str, str]:
    """Name and type of the service whose events a topic carries."""
    return topic.removesuffix(_EVENT_TOPIC), type_name.removesuffix(_EVENT_TYPE)


def info(metadata: BagMetadata, counts: Mapping[str, tuple[int, int]] | None = None) -> str:
    """The text about a bag.

    Args:
        metadata: What the bag holds.
        counts: Numbers of requests and responses by service; None tells only how many events.
    """
    topics: list[TopicInformation] = []
    services: list[TopicInformation] = []
    for item in metadata.topics_with_message_count:
        is_event = is_service_event(item.topic_metadata.name, item.topic_metadata.type)
        (services if is_event else topics).append(item)
    start = metadata.starting_time.nanoseconds
    duration = metadata.duration.nanoseconds
    messages = metadata.message_count - sum(item.message_count for item in services)
    lines = [
        "",
        _labelled("Files:", metadata.relative_file_paths, _LABEL_WIDTH),
        _labelled("Bag size:", [_size(metadata.bag_size)], _LABEL_WIDTH),
        _labelled("Storage id:", [metadata.storage_identifier], _LABEL_WIDTH),
        _labelled("ROS Distro:", [metadata.ros_distro or "unknown"], _LABEL_WIDTH),
        _labelled("Duration:", [f"{_seconds(duration)}s"], _LABEL_WIDTH),
        _labelled("Start:", [_date(start)], _LABEL_WIDTH),
        _labelled("End:", [_date(start + duration)], _LABEL_WIDTH),
        _labelled("Messages:", [str(messages)], _LABEL_WIDTH),
        _labelled("Topic information:", [_topic(item) for item in topics], _LABEL_WIDTH),
        _labelled("Service:", [str(len(services))], _LABEL_WIDTH),
        _labelled(
            "Service information:", [_service(item, counts) for item in services], _SERVICE_WIDTH
        ),
    ]
    return "\n".join(lines) + ("\n" if services else "")


def _labelled(label: str, values: list[str], width: int) -> str:
    return label.ljust(width) + f"\n{' ' * width}".join(values)


def _topic(item: TopicInformation) -> str:
    topic = item.topic_metadata
    return (
        f"Topic: {topic.name} | Type: {topic.type} | Count: {item.message_count} | "
        f"Serialization Format: {topic.serialization_format}"
    )


def _service(item: TopicInformation, counts: Mapping[str, tuple[int, int]] | None) -> str:
    topic = item.topic_metadata
    name, type_name = service_of(topic.name, topic.type)
    if counts is None:
        count = f"Event Count: {item.message_count}"
    else:
        requests, responses = counts.get(name, (0, 0))
        count = f"Request Count: {requests} | Response Count: {responses}"
    return (
        f"Service: {name} | Type: {type_name} | {count} | "
        f"Serialization Format: {topic.serialization_format}"
    )


def _size(count: int) -> str:
    size, unit = float(count), 0
    while size >= 1024 and unit < len(_UNITS) - 1:
        size /= 1024
        unit += 1
    return f"{size:.1f} {_UNITS[unit]}" if unit else f"{count} B"


def _seconds(nanoseconds: int) -> str:
    return f"{nanoseconds // 1_000_000_000}.{nanoseconds % 1_000_000_000:09d}"


def _date(nanoseconds: int) -> str:
    local = time.localtime(nanoseconds // 1_000_000_000)
    date = f"{time.strftime('%b', local)} {local.tm_mday:2d} {time.strftime('%Y %H:%M:%S', local)}"
    return f"{date}.{nanoseconds % 1_000_000_000:09d} ({_seconds(nanoseconds)})"
