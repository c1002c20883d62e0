"""Ours: lookups of one and of two threads on one buffer."""

import os
import sys
import threading
import time

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from clock import report, summary
from turtlewire_buffer import filled
from world import RECENT, random_stamps

RUNS = 200  # of about 2 ms each: on a busy machine some of them are undisturbed
BATCH = 1000


# Each returns what a thread does. It has its own objects, and takes the method from the buffer only
# once: until Python 3.14, threads wait for each other where they count references to one object.


def latest(buffer):
    lookup = buffer.lookup_transform

    def work(number):
        for _ in range(number):
            lookup("map", "camera")

    return work


def interpolated(buffer):
    lookup, recent = buffer.lookup_transform, int(str(RECENT))

    def work(number):
        for _ in range(number):
            lookup("map", "camera", recent)

    return work


def batch(buffer):
    import numpy as np

    lookup, stamps = buffer.lookup_transforms, np.array(random_stamps(BATCH), dtype=np.int64)
    out = np.empty((BATCH, 7))

    def work(number):
        for _ in range(number // BATCH):
            lookup("map", "camera", stamps, out=out)

    return work


def together(make, buffer, threads, number):
    """Nanoseconds in which one of all lookups is made."""
    ready, times = [], []

    def play():
        work = make(buffer)
        ready.append(None)
        while len(ready) < threads:  # begin within microseconds of each other
            pass
        begin = time.perf_counter_ns()
        work(number)
        times.append((begin, time.perf_counter_ns()))

    players = [threading.Thread(target=play) for _ in range(threads)]
    for player in players:
        player.start()
    for player in players:
        player.join()
    begins, ends = zip(*times, strict=True)
    return (max(ends) - min(begins)) / number / threads


def main():
    buffer = filled()
    figures = {}
    for make, number in ((latest, 20_000), (interpolated, 10_000), (batch, 20_000)):
        runs = {1: [], 2: []}
        for _ in range(RUNS):
            for threads, found in runs.items():
                found.append(together(make, buffer, threads, number))
        for threads, found in runs.items():
            figures[f"{make.__name__} {threads}"] = summary(found)
    report(figures)


if __name__ == "__main__":
    main()
