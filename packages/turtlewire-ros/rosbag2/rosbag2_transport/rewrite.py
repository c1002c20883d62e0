"""Writes the messages of bags into other bags: what ``ros2 bag convert`` does."""

from __future__ import annotations

import heapq
import shutil
import time
from dataclasses import dataclass
from typing import TYPE_CHECKING

from rclpy.logging import get_logger
from rosbag2_transport.progress import ProgressLine, time_text
from rosbag2_transport.topic_filter import TopicFilter
from turtlewire.terminal.suggestion import did_you_mean

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from rosbag2_transport.options import RecordOptions
    from turtlewire.bag import Bag, BagMessage, BagWriter

__all__ = ["Output", "rewrite"]


@dataclass
class Output:
    """A bag to write, and what goes into it.

    Attributes:
        writer: The bag.
        options: Chooses the topics, as in a recording.
        start_ns: Log time of the first message; negative for all.
        end_ns: Log time of the last message; negative for all.
    """

    writer: BagWriter
    options: RecordOptions
    start_ns: int = -1
    end_ns: int = -1


def rewrite(inputs: Sequence[Bag], outputs: Sequence[Output]) -> None:
    """Write all messages of some bags, in order of their log times, into others.

    Args:
        inputs: Open bags.
        outputs: They are closed at the end; Ctrl-C removes them, because half a bag looks whole.

    Raises:
        RuntimeError: A pattern is not a regular expression.
        BagError: A topic has different types, or a bag is damaged; what can be read is written.
        OSError: The disk is full, for example.
    """
    done = 0
    started = time.monotonic()
    try:
        chosen = [_add_topics(inputs, output) for output in outputs]
        wanted = set().union(*chosen)
        streams = [bag.messages([name for name in bag.topics if name in wanted]) for bag in inputs]
        recorded = (topic for bag in inputs for topic in bag.metadata.topics)
        expected = sum(topic.message_count for topic in recorded if topic.name in wanted)
        with ProgressLine(lambda: _progress(done, expected, time.monotonic() - started)):
            for message in heapq.merge(*streams, key=_log_time):
                for output, topics in zip(outputs, chosen, strict=True):
                    if message.topic in topics and _is_in_time(output, message.log_time_ns):
                        output.writer.write(*_fields(message))
                done += 1
    except KeyboardInterrupt:
        _discard(outputs, done)
        raise
    finally:
        for output in outputs:
            output.writer.close()


def _discard(outputs: Sequence[Output], done: int) -> None:
    """Remove the bags of an interrupted conversion, and log it."""
    for output in outputs:
        output.writer.close()
        shutil.rmtree(output.writer.path)
    paths = ", ".join(output.writer.path for output in outputs)
    get_logger("rosbag2_transport").warning(
        f"Interrupted after {done} messages: what was converted is incomplete and removed ({paths})"
    )


def _progress(done: int, expected: int, seconds: float) -> str:
    if not done or not expected:
        return "converting"
    share = min(1.0, done / expected)
    return f"converting: {share:4.0%}, {time_text(seconds * (1 - share) / share)} left"


def _add_topics(inputs: Sequence[Bag], output: Output) -> set[str]:
    """Add the topics that an output chooses to it; returns their names."""
    logger = get_logger("rosbag2_transport")

    def complain(severity: str, text: str) -> None:
        (logger.error if severity == "error" else logger.warning)(text)

    topics = TopicFilter(output.options, complain)
    names = set()
    for bag in inputs:
        definitions = bag.definitions()
        for topic in bag.metadata.topics:
            if topics.takes(topic.name, [topic.type], published=True, heard=True):
                names.add(topic.name)
                output.writer.add_topic(
                    topic.name,
                    topic.type,
                    qos=topic.qos,
                    hash_of_type=topic.type_hash or None,
                    definition=definitions.get(topic.type),
                )
    for text in _mistakes({name for bag in inputs for name in bag.topics}, names, output):
        logger.warning(text)
    return names


def _mistakes(known: set[str], chosen: set[str], output: Output) -> Iterator[str]:
    """Yield names in the options that the bags do not have, or that nothing is chosen."""
    path, options = output.writer.path, output.options
    unknown = [name for name in (*options.topics, *options.services) if name not in known]
    for name in unknown:
        hint = did_you_mean(name, known) or f"Their topics are {', '.join(sorted(known))}."
        yield f"Nothing of {name} is written to {path}: the bags do not have it. {hint}"
    if not chosen and not unknown:
        yield (
            f"Nothing is written to {path}: choose by all, all_topics, all_services, topics, "
            "topic_types, services or regex."
        )


def _is_in_time(output: Output, time_ns: int) -> bool:
    return time_ns >= output.start_ns and (output.end_ns < 0 or time_ns <= output.end_ns)


def _fields(message: BagMessage) -> tuple[str, bytes, int, int]:
    return message.topic, message.data, message.log_time_ns, message.publish_time_ns


def _log_time(message: BagMessage) -> int:
    return message.log_time_ns
