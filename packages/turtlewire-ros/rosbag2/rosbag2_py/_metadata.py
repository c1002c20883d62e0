"""Metadata of a bag, and its text for ``ros2 bag info``."""

from __future__ import annotations

import time
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from rclpy.duration import Duration
from rclpy.time import Time
from rosbag2_transport.topic_filter import (
    ACTION_PARTS,
    ActionTopic,
    action_topic,
    is_service_event,
    service_of,
)
from turtlewire.bag import metadata as engine
from turtlewire.bag.times import size_text
from turtlewire.distro import KILTED, since

if TYPE_CHECKING:
    from datetime import timedelta

    from rclpy.qos import QoSProfile

_LABEL_WIDTH, _SERVICE_WIDTH = 19, 21


@dataclass(slots=True)
class TopicMetadata:
    """A topic.

    Attributes:
        id: A number of the caller's choice.
        name: ``/tf``.
        type: ``tf2_msgs/msg/TFMessage``.
        serialization_format: ``cdr``.
        offered_qos_profiles: What each publisher offers.
        type_description_hash: ``RIHS01_…`` or empty.
    """

    id: int
    name: str
    type: str
    serialization_format: str
    offered_qos_profiles: list[QoSProfile] = field(default_factory=list)
    type_description_hash: str = ""

    def equals(self, other: TopicMetadata) -> bool:
        """Return True if both describe the same topic; the number does not count."""
        return (self.name, self.type, self.serialization_format, self.offered_qos_profiles) == (
            other.name,
            other.type,
            other.serialization_format,
            other.offered_qos_profiles,
        )


@dataclass(slots=True)
class TopicInformation:
    """A topic and how many messages of it a bag holds."""

    topic_metadata: TopicMetadata
    message_count: int


@dataclass(slots=True)
class FileInformation:
    """A file of a bag.

    Attributes:
        path: Relative to the bag's folder.
        starting_time: Log time of its first message.
        duration: From its first to its last message, cut to microseconds as in ROS 2.
        message_count: Number of its messages.
    """

    path: str
    starting_time: Time
    duration: timedelta
    message_count: int


@dataclass(slots=True)
class BagMetadata:
    """Topics, times and files of a bag; ``str()`` gives the text of ``ros2 bag info``."""

    version: int = engine.NEWEST_VERSION
    bag_size: int = 0
    storage_identifier: str = ""
    relative_file_paths: list[str] = field(default_factory=list)
    files: list[FileInformation] = field(default_factory=list)
    duration: Duration = field(default_factory=Duration)
    starting_time: Time = field(default_factory=Time)
    message_count: int = 0
    topics_with_message_count: list[TopicInformation] = field(default_factory=list)
    compression_format: str = ""
    compression_mode: str = ""
    custom_data: dict[str, str] = field(default_factory=dict)
    ros_distro: str = ""

    def __str__(self) -> str:
        return info(self)


def info(metadata: BagMetadata, counts: Mapping[str, tuple[int, int]] | None = None) -> str:
    """Return the text about a bag.

    Args:
        metadata: The content of the bag.
        counts: Numbers of requests and responses by service; None counts events only.
    """
    topics: list[TopicInformation] = []
    services: list[TopicInformation] = []
    actions: dict[str, dict[str, TopicInformation]] = {}
    for item in metadata.topics_with_message_count:
        topic = item.topic_metadata
        if action := action_of(topic.name, topic.type):
            actions.setdefault(action.action, {})[action.part] = item
        elif is_service_event(topic.name, topic.type):
            services.append(item)
        else:
            topics.append(item)
    start = metadata.starting_time.nanoseconds
    duration = metadata.duration.nanoseconds
    # As in ROS 2, neither service events nor actions count.
    messages = sum(item.message_count for item in topics)
    lines = [
        "",
        _labelled("Files:", metadata.relative_file_paths, _LABEL_WIDTH),
        _labelled("Bag size:", [size_text(metadata.bag_size)], _LABEL_WIDTH),
        _labelled("Storage id:", [metadata.storage_identifier], _LABEL_WIDTH),
        _labelled("ROS Distro:", [metadata.ros_distro or "unknown"], _LABEL_WIDTH),
        _labelled("Duration:", [f"{_seconds(duration)}s"], _LABEL_WIDTH),
        _labelled("Start:", [_date(start)], _LABEL_WIDTH),
        _labelled("End:", [_date(start + duration)], _LABEL_WIDTH),
        _labelled("Messages:", [str(messages)], _LABEL_WIDTH),
        _labelled("Topic information:", [_topic(item) for item in topics], _LABEL_WIDTH),
        _labelled("Services:" if since(KILTED) else "Service:", [str(len(services))], _LABEL_WIDTH),
        _labelled(
            "Service information:", [_service(item, counts) for item in services], _SERVICE_WIDTH
        ),
    ]
    if since(KILTED):
        lines += _actions(actions, counts)
    return "\n".join(lines) + ("\n" if services or actions else "")


def _actions(
    actions: Mapping[str, Mapping[str, TopicInformation]],
    counts: Mapping[str, tuple[int, int]] | None,
) -> list[str]:
    """Return the lines about actions, from Kilted on."""
    lines = [_labelled("Actions:", [str(len(actions))], _LABEL_WIDTH), "Action information:"]
    for name, parts in actions.items():
        topics = {part: item.topic_metadata for part, item in parts.items()}
        known = (action_of(topic.name, topic.type) for topic in topics.values())
        type_name = next((each.type for each in known if each and each.type), "")
        formats = next(topic.serialization_format for topic in topics.values())
        lines.append(
            f"  Action: {name} | Type: {type_name} | Topics: 2 | Service: 3 | "
            f"Serialization Format: {formats}"
        )
        for part in ACTION_PARTS:
            count = parts[part].message_count if part in parts else 0
            if part in {"feedback", "status"}:
                lines.append(f"    Topic: {part} | Count: {count}")
            else:
                numbers = _events(f"{name}/_action/{part}", count, counts)
                lines.append(f"    Service: {part} | {numbers}")
    return lines


def _events(service: str, events: int, counts: Mapping[str, tuple[int, int]] | None) -> str:
    if counts is None:
        return f"Event Count: {events}"
    requests, responses = counts.get(service, (0, 0))
    return f"Request Count: {requests} | Response Count: {responses}"


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
    count = _events(name, item.message_count, counts)
    return (
        f"Service: {name} | Type: {type_name} | {count} | "
        f"Serialization Format: {topic.serialization_format}"
    )


def _seconds(nanoseconds: int) -> str:
    return f"{nanoseconds // 1_000_000_000}.{nanoseconds % 1_000_000_000:09d}"


def _date(nanoseconds: int) -> str:
    local = time.localtime(nanoseconds // 1_000_000_000)
    # The day has a space in front and not a zero, as in ROS 2; Windows has no `%e` for it.
    date = f"{time.strftime('%b', local)} {local.tm_mday:2d} {time.strftime('%Y %H:%M:%S', local)}"
    return f"{date}.{nanoseconds % 1_000_000_000:09d} ({_seconds(nanoseconds)})"


def action_of(topic: str, type_name: str) -> ActionTopic | None:
    """Return the action of a topic and its part; None for other topics, and up to Jazzy."""
    return action_topic(topic, type_name) if since(KILTED) else None
