"""mcap: raw messages of a bag in order of time, and writing them."""

import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2]))
from mcap.reader import make_reader
from mcap.writer import CompressionType, Writer

from benchmarks.bag_data import SINGLE, folder, tf_messages
from benchmarks.clock import report, summary


def iterate(name):
    start = time.process_time_ns()
    (path,) = (folder() / name).glob("*.mcap")
    with path.open("rb") as file:
        for _ in make_reader(file).iter_messages():
            pass
    return time.process_time_ns() - start


def write():
    messages = list(tf_messages(SINGLE, 1, 1_000_000))
    start = time.process_time_ns()
    with (folder() / "rival.mcap").open("wb") as file:
        writer = Writer(file, compression=CompressionType.ZSTD)
        writer.start("ros2")
        schema = writer.register_schema("tf2_msgs/msg/TFMessage", "ros2msg", b"")
        channel = writer.register_channel("/tf", "cdr", schema)
        for stamp, data in messages:
            writer.add_message(channel, stamp, data, stamp)
        writer.finish()
    return time.process_time_ns() - start


figures = {name: summary([iterate(name)]) for name in ("one", "several")}
report(figures | {"writing": summary([write()])})
