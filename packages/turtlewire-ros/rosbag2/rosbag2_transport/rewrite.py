"""Writes the messages of bags into other bags: what ``ros2 bag convert`` does."""

from __future__ import annotations

import heapq
import shutil
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from operator import attrgetter
from typing import TYPE_CHECKING

from rclpy.logging import get_logger
from rosbag2_transport.progress import ProgressLine, time_text
from rosbag2_transport.topic_filter import TopicFilter
from turtlewire.bag.metadata import is_decodable, not_in_cdr
from turtlewire.errors import BagError
from turtlewire.msg.evolution import older_evolution
from turtlewire.terminal.printable import printable
from turtlewire.terminal.suggestion import did_you_mean
from turtlewire.wording import counted

if TYPE_CHECKING:
    from rosbag2_transport.options import RecordOptions
    from turtlewire.bag import Bag, BagMessage, BagWriter


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


def rewrite(inputs: Sequence[Bag], outputs: Sequence[Output]) -> list[str]:
    """Write all messages of some bags, in order of their log times, into others.

    Args:
        inputs: Open bags.
        outputs: They are closed at the end. They are removed if nothing was written before an
            error, and by Ctrl-C, because a partial bag looks complete.

    Returns:
        What is left out, one sentence for each topic: topics that are not in CDR, and messages
        without bytes.

    Raises:
        RuntimeError: A pattern is not a regular expression.
        BagError: A topic has different types, or a bag is damaged; what can be read is written. The
            text also names what is left out.
        OSError: The disk is full, for example.
    """
    done = 0
    started = time.monotonic()
    left_out: dict[str, str] = {}
    try:
        disputed = _disputed_types(inputs)
        chosen = [_add_topics(inputs, output, disputed, left_out) for output in outputs]
        wanted = set().union(*chosen)
        recorded = (topic for bag in inputs for topic in bag.metadata.topics)
        expected = sum(topic.message_count for topic in recorded if topic.name in wanted)
        with ProgressLine(lambda: _progress(done, expected, time.monotonic() - started)):
            for message in _messages(inputs, wanted, disputed, left_out):
                for output, topics in zip(outputs, chosen, strict=True):
                    if message.topic in topics and _is_in_time(output, message.log_time_ns):
                        output.writer.write(*_fields(message))
                done += 1
    except KeyboardInterrupt:
        _discard(outputs)
        paths = ", ".join(output.writer.path for output in outputs)
        get_logger("rosbag2_transport").warning(
            f"Interrupted after {counted(done, 'message')}: what was converted is incomplete and "
            f"removed ({paths})"
        )
        raise
    except BagError as error:
        if not done:
            _discard(outputs)
        damage = "; ".join(map(str, (error, *error.others)))
        raise BagError(" ".join([*left_out.values(), damage])).with_hint(error.hint) from error
    except Exception:
        if not done:
            _discard(outputs)
        raise
    else:
        if left_out and not wanted:
            _discard(outputs)
    finally:
        for output in outputs:
            output.writer.close()
    return list(left_out.values())


def _messages(
    inputs: Sequence[Bag], wanted: set[str], disputed: set[str], left_out: dict[str, str]
) -> Iterator[BagMessage]:
    """Yield the messages to write, in order; disputed types follow our definition."""
    streams = [bag.messages([name for name in bag.topics if name in wanted]) for bag in inputs]
    # Each bag is in order already, so one message of each is enough in memory.
    for message in heapq.merge(*streams, key=attrgetter("log_time_ns")):
        if not message.data:
            text = f"Messages of {message.topic} have no bytes: left out."
            left_out[message.topic] = printable(text)
        elif message.type in disputed:
            yield message._replace(data=message.upgraded_data())
        else:
            yield message


def _discard(outputs: Sequence[Output]) -> None:
    """Remove the bags of a conversion."""
    for output in outputs:
        output.writer.close()
        shutil.rmtree(output.writer.path)


def _progress(done: int, expected: int, seconds: float) -> str:
    if not done or not expected:
        return "converting"
    # The metadata of a damaged bag may count too few messages.
    share = min(1.0, done / expected)
    return f"converting: {share:4.0%}, {time_text(seconds * (1 - share) / share)} left"


def _disputed_types(inputs: Sequence[Bag]) -> set[str]:
    """Return the types that the bags define differently; an output has one definition of each.

    Among them are types that a bag does not define and that an older ROS 2 defined differently.
    """
    found: dict[str, str] = {}
    disputed = set()
    for bag in inputs:
        definitions = bag.definitions()
        for name, (_, text) in definitions.items():
            if found.setdefault(name, text) != text:
                disputed.add(name)
        undefined = {each.type for each in bag.metadata.topics} - definitions.keys()
        disputed |= {name for name in undefined if older_evolution(name)}
    return disputed


def _add_topics(
    inputs: Sequence[Bag], output: Output, disputed: set[str], left_out: dict[str, str]
) -> set[str]:
    """Add the topics that an output chooses to it; returns their names.

    Those that cannot be decoded go to ``left_out``: rosbag2 would take their bytes for CDR.
    """
    logger = get_logger("rosbag2_transport")

    def complain(severity: str, text: str) -> None:
        (logger.error if severity == "error" else logger.warning)(text)

    topics = TopicFilter(output.options, complain)
    names = set()
    for bag in inputs:
        definitions = bag.definitions()
        for topic in bag.metadata.topics:
            if topics.takes(topic.name, [topic.type], published=True, heard=True):
                if not is_decodable(topic):
                    left_out[topic.name] = not_in_cdr([topic], "left out")
                    continue
                names.add(topic.name)
                output.writer.add_topic(
                    topic.name,
                    topic.type,
                    qos=topic.qos,
                    hash_of_type=None if topic.type in disputed else topic.type_hash or None,
                    definition=None if topic.type in disputed else definitions.get(topic.type),
                )
    chosen = names | left_out.keys()
    for text in _mistakes({name for bag in inputs for name in bag.topics}, chosen, output):
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
