"""rosbags: raw messages of a bag, without decoding them."""

import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2]))
from rosbags.highlevel import AnyReader

from benchmarks.bag_data import folder
from benchmarks.clock import report, summary


def iterate(name):
    start = time.process_time_ns()
    with AnyReader([folder() / name]) as reader:
        for _ in reader.messages():
            pass
    return time.process_time_ns() - start


report({name: summary([iterate(name) for _ in range(2)]) for name in ("one", "several")})
