"""turtlewire: a bag's transforms into a buffer, writing a bag, APE and RPE. CPU of the process."""

import gc
import shutil
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2]))
from benchmarks.bag_data import LINKS, SEVERAL, SINGLE, folder, tf_messages, trajectories
from benchmarks.clock import report, summary
from turtlewire import Buffer
from turtlewire.bag import BagWriter, open_bag
from turtlewire.tf.plain import RecordWalk
from turtlewire.trajectory import Trajectory
from turtlewire.trajectory.alignment import align
from turtlewire.trajectory.metrics import ape, rpe

import numpy as np  # isort: skip -- so that its import is in no figure

TYPE = "tf2_msgs/msg/TFMessage"


def cpu(function, runs=5):
    """CPU nanoseconds of the process, its threads included."""
    figures = []
    for _ in range(runs):
        gc.collect()
        start = time.process_time_ns()
        function()
        figures.append(time.process_time_ns() - start)
    return summary(figures)


def write(path, messages):
    with BagWriter(path, compression="zstd") as writer:
        writer.add_topic("/tf", TYPE)
        for stamp, data in messages:
            writer.write("/tf", data, stamp)


def writing(path):
    messages = list(tf_messages(SINGLE, 1, 1_000_000))

    def write_again():
        shutil.rmtree(path, ignore_errors=True)
        write(path, messages)

    return cpu(write_again, 3)


def plain_walk(path):
    """Read without the native walk: records in Python, samples in the native store."""
    buffer, walk = Buffer(None), RecordWalk(0, (1 << 64) - 1)
    with open_bag(path) as bag:
        for file in bag.files():
            for chunk in file.chunks(lambda _: True, 0, 1 << 64):
                records = file.file.records(chunk)
                walk.walk(buffer, records, dict.fromkeys(file.file.channels, ("/tf", False)))
    return buffer


def main():
    one, several = folder() / "one", folder() / "several"
    figures = {"writing": writing(one)}
    write(several, tf_messages(SEVERAL, LINKS, 10_000_000))
    figures["one"] = cpu(lambda: Buffer.from_bag(one))
    figures["plain walk"] = cpu(lambda: plain_walk(one), 3)
    figures["several"] = cpu(lambda: Buffer.from_bag(several))
    stamps, p, q, estimated_p, estimated_q = trajectories()
    reference = Trajectory(stamps, np.hstack((p, q)))
    estimate = Trajectory(stamps, np.hstack((estimated_p, estimated_q)))
    figures["ape"] = cpu(lambda: ape(reference, estimate).statistics)
    figures["ape full"] = cpu(lambda: ape(reference, estimate, "full").statistics)
    figures["rpe"] = cpu(lambda: rpe(reference, estimate).statistics)
    figures["align"] = cpu(lambda: align(reference, estimate, "se3"))
    report(figures)


if __name__ == "__main__":
    main()
