"""Timing, shared by all adapters.

Plain Python of any version, because rivals run on other interpreters.
"""

import json
import statistics
import sys
import time
import timeit


def per_call(statement, names, seconds=1.0):
    """Nanoseconds for one execution of a statement: (minimum, median) of many short runs.

    The loop itself (5 ns) is in it.

    The runs last about 2 ms: on a busy machine some of them are undisturbed.
    """
    timer = timeit.Timer(statement, globals=names)
    number, elapsed = 1, 0.0
    while elapsed < 0.002:
        number = number * 2 if elapsed < 0.0005 else int(number * 0.0022 / elapsed) + 1
        elapsed = timer.timeit(number)
    runs = [run / number * 1e9 for run in timer.repeat(max(5, int(seconds / elapsed)), number)]
    return min(runs), statistics.median(runs)


def cpu_per_item(store, fresh, count, repeats=20):
    """Nanoseconds of CPU in which `store` puts one of `count` items into what `fresh` returns."""
    runs = []
    for _ in range(repeats):
        place = fresh()
        begin = time.process_time_ns()
        store(place)
        runs.append((time.process_time_ns() - begin) / count)
    return summary(runs)


def summary(runs):
    """(minimum, median) of figures that were measured some other way."""
    return min(runs), statistics.median(runs)


def report(figures):
    """Hand the figures, {case: (minimum, median)}, to the runner."""
    json.dump(figures, sys.stdout)
