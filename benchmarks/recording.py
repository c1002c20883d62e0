"""Records 200 MB a minute, and plays at three rates: what is lost, and how late messages come.

    python -m benchmarks.recording --minutes 10

publishes images of 100 kB and small messages with numbers, records them with ``ros2 bag record``,
and compares the bag with what was sent. `scripts/bench recording` plays a bag of 100 messages a
second and measures when each message is published.
"""

from __future__ import annotations

import argparse
import os
import signal
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from benchmarks.figures import Figure, Row
from turtlewire.bag import BagWriter, open_bag
from turtlewire.msg import get_message, serialize
from turtlewire.testing import isolated_domain
from turtlewire.wire import open_context
from turtlewire.wire.base import TypeId
from turtlewire.wire.qos import QoS

if TYPE_CHECKING:
    from rosbag2_transport.player import BagPlayer
    from turtlewire.bag import BagMessage
    from turtlewire.wire.base import Graph, Publisher

TITLE = "Playing a bag (how late messages are published; not min / median, but median / 99 %)"

SECOND = 1_000_000_000
START = 1_700_000_000 * SECOND
STRING = "std_msgs/msg/String"
#: Topic, bytes of a message and messages in a second: 3.34 MB a second, 200 MB a minute.
STREAMS = (("/image", 100_000, 33), ("/imu", 40, 1000))
RATES = (1.0, 10.0, 0.1)


@contextmanager
def publishers() -> Iterator[tuple[dict[str, Publisher], Graph]]:
    """A node that publishes strings on each topic of `STREAMS`, and the graph around it."""
    from turtlewire.msg import type_hash

    context = open_context()
    node = context.create_node("load")
    type_id = TypeId(STRING, type_hash(STRING))
    try:
        writers = {
            topic: node.create_publisher(topic, type_id, QoS(depth=1000)) for topic, *_ in STREAMS
        }
        yield writers, context.graph
    finally:
        context.close()


def number(count: int, size: int) -> bytes:
    """A message that holds a number."""
    return serialize(get_message(STRING)(data=f"{count:<{size}}"))


def send(writers: dict[str, Publisher], seconds: float) -> dict[str, int]:
    """Publish in steps of a millisecond; returns how many messages on each topic."""
    sent = dict.fromkeys(writers, 0)
    begin = time.monotonic()
    while (elapsed := time.monotonic() - begin) < seconds:
        for topic, size, rate in STREAMS:
            while sent[topic] < elapsed * rate:
                writers[topic].publish(number(sent[topic], size))
                sent[topic] += 1
        time.sleep(0.001)
    return sent


def load(minutes: float) -> int:
    """Record for some minutes; returns how many messages are missing in the bag."""
    with (
        tempfile.TemporaryDirectory() as folder,
        isolated_domain(),
        publishers() as (writers, graph),
    ):
        ros2 = Path(sys.executable).parent / "ros2"
        words = ("record", "-a", "-o", "bag", "--disable-keyboard-controls")
        recorder = subprocess.Popen([ros2, "bag", *words], cwd=folder)
        graph.wait_for(lambda: all(writer.subscription_count() for writer in writers.values()))
        sent = send(writers, minutes * 60)
        for writer in writers.values():
            writer.wait_for_acknowledgments(60 * SECOND)
        before = os.times()
        recorder.send_signal(signal.SIGINT)
        recorder.wait()
        after = os.times()
        cpu = after.children_user + after.children_system
        cpu -= before.children_user + before.children_system
        with open_bag(Path(folder) / "bag") as bag:
            found = {topic: bag.topics[topic].message_count for topic in sent}
            numbers = [int(message.data[8:].rstrip(b"\0 ")) for message in bag.messages("/imu")]
        size = sum(file.stat().st_size for file in Path(folder, "bag").iterdir())
    lost = sum(sent.values()) - sum(found.values())
    in_order = numbers == list(range(sent["/imu"]))
    print(
        f"{minutes:g} minutes, {size / 1e6 / minutes:.0f} MB a minute: sent {sent}, recorded "
        f"{found}, lost {lost}, in order: {in_order}; CPU {cpu / minutes / 60:.1%} of one core"
    )
    return lost


def note(player: BagPlayer, errors: list[float], message: BagMessage) -> None:
    """Note how many milliseconds a message is late as it is published."""
    errors.append((player.clock.now_ns() - message.log_time_ns) / player.clock.rate * 1e-6)


def lateness() -> Iterator[tuple[float, list[float]]]:
    """Play at three rates; each with the milliseconds by which its messages are late, in order."""
    from rosbag2_transport.options import PlayOptions
    from rosbag2_transport.player import BagPlayer
    from rosbag2_transport.session import BagSession

    with tempfile.TemporaryDirectory() as folder, isolated_domain():
        path = f"{folder}/bag"
        with BagWriter(path, compression="zstd") as writer:
            writer.add_topic("/imu", STRING)
            for i in range(10_000):
                writer.write("/imu", number(i, 40), START + i * SECOND // 100)
        for rate in RATES:
            errors: list[float] = []
            options = PlayOptions(rate=rate, playback_duration=5.0 * rate)
            with BagSession("timing") as session:
                player = BagPlayer(session.node, path, options)
                player.on_publish.append(partial(note, player, errors))
                player.play()
                player.close()
            yield rate, sorted(errors)


def rows() -> Iterator[Row]:
    """Measure the delay of published messages at three rates."""
    for rate, errors in lateness():
        middle, late = statistics.median(errors), errors[int(len(errors) * 0.99)]
        yield Row(f"{rate:g}x, {len(errors)} messages", Figure(middle, late, "ms"))


def main() -> int:
    """Record; the status is 1 if messages are missing."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--minutes", type=float, default=10.0)
    return int(load(parser.parse_args().minutes) != 0)


if __name__ == "__main__":
    sys.exit(main())
