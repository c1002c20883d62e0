"""Numba by hand.

One compiled loop over the stamps, with a binary search and a SLERP for each of the three links.
"""

import math
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
import numpy as np
from clock import per_call, report
from numba import njit
from world import FIRST, SAMPLES, STEP, pose, random_stamps

STAMPS = FIRST + np.arange(SAMPLES, dtype=np.int64) * STEP
LINKS = np.array([[pose(link, i) for i in range(SAMPLES)] for link in range(3)])


@njit
def interpolate(stamps, samples, time, out):
    i = min(np.searchsorted(stamps, time, side="right") - 1, len(stamps) - 2)
    u = (time - stamps[i]) / (stamps[i + 1] - stamps[i])
    a, b = samples[i], samples[i + 1]
    cosine = a[3] * b[3] + a[4] * b[4] + a[5] * b[5] + a[6] * b[6]
    angle = math.acos(min(abs(cosine), 1.0))
    wa, wb = 1.0 - u, u
    if math.sin(angle) > 1e-9:
        wa, wb = (
            math.sin((1.0 - u) * angle) / math.sin(angle),
            math.sin(u * angle) / math.sin(angle),
        )
    if cosine < 0:
        wb = -wb
    for k in range(3):
        out[k] = (1.0 - u) * a[k] + u * b[k]
    for k in range(3, 7):
        out[k] = wa * a[k] + wb * b[k]


@njit
def multiply(a, b, out):
    """The pose `a * b`; `out` may be `b`."""
    x, y, z, w = a[3], a[4], a[5], a[6]
    tx, ty, tz = 2 * (y * b[2] - z * b[1]), 2 * (z * b[0] - x * b[2]), 2 * (x * b[1] - y * b[0])
    moved = (
        a[0] + b[0] + w * tx + y * tz - z * ty,
        a[1] + b[1] + w * ty + z * tx - x * tz,
        a[2] + b[2] + w * tz + x * ty - y * tx,
    )
    turned = (
        w * b[3] + x * b[6] + y * b[5] - z * b[4],
        w * b[4] + y * b[6] + z * b[3] - x * b[5],
        w * b[5] + z * b[6] + x * b[4] - y * b[3],
        w * b[6] - x * b[3] - y * b[4] - z * b[5],
    )
    out[0], out[1], out[2] = moved
    out[3], out[4], out[5], out[6] = turned


@njit
def lookup(stamps, links, times, out):
    outer = np.empty(7)
    for n in range(len(times)):
        interpolate(stamps, links[2], times[n], out[n])
        for link in (1, 0):
            interpolate(stamps, links[link], times[n], outer)
            multiply(outer, out[n], out[n])


def main():
    names = {"lookup": lookup, "STAMPS": STAMPS, "LINKS": LINKS, "out": np.empty((100_000, 7))}
    names["stamps"] = np.array(random_stamps(100_000), dtype=np.int64)
    names["sorted_stamps"] = np.sort(names["stamps"])
    lookup(STAMPS, LINKS, names["stamps"], names["out"])  # compiles it
    figures = {}
    for case, which in (("batch random", "stamps"), ("batch sorted", "sorted_stamps")):
        figures[case] = [
            value / 1e5 for value in per_call(f"lookup(STAMPS, LINKS, {which}, out)", names)
        ]
    report(figures)


if __name__ == "__main__":
    main()
