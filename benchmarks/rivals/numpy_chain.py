"""NumPy by hand: the chain's links as arrays, searchsorted, vectorised SLERP and products.

Chain and answers as ours.
"""

import os
import sys

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
import numpy as np
from clock import per_call, report
from world import FIRST, SAMPLES, STEP, pose, random_stamps

STAMPS = FIRST + np.arange(SAMPLES, dtype=np.int64) * STEP
LINKS = [np.array([pose(link, i) for i in range(SAMPLES)]) for link in range(3)]


def interpolate(samples, times):
    i = np.minimum(np.searchsorted(STAMPS, times, side="right") - 1, SAMPLES - 2)
    u = ((times - STAMPS[i]) / STEP)[:, None]
    a, b = samples[i], samples[i + 1]
    cosine = np.sum(a[:, 3:] * b[:, 3:], axis=1, keepdims=True)
    angle = np.arccos(np.minimum(np.abs(cosine), 1.0))
    sine = np.sin(angle)
    small = sine < 1e-9
    safe = np.where(small, 1.0, sine)
    wa = np.where(small, 1 - u, np.sin((1 - u) * angle) / safe)
    wb = np.where(small, u, np.sin(u * angle) / safe) * np.where(cosine < 0, -1.0, 1.0)
    return (1 - u) * a[:, :3] + u * b[:, :3], wa * a[:, 3:] + wb * b[:, 3:]


def rotate(q, v):
    t = 2 * np.cross(q[:, :3], v)
    return v + q[:, 3:] * t + np.cross(q[:, :3], t)


def multiply(a, b):
    vector = a[:, 3:] * b[:, :3] + b[:, 3:] * a[:, :3] + np.cross(a[:, :3], b[:, :3])
    scalar = a[:, 3:] * b[:, 3:] - np.sum(a[:, :3] * b[:, :3], axis=1, keepdims=True)
    return np.concatenate([vector, scalar], axis=1)


def lookup(times):
    t, q = interpolate(LINKS[2], times)
    for samples in (LINKS[1], LINKS[0]):
        outer_t, outer_q = interpolate(samples, times)
        t, q = outer_t + rotate(outer_q, t), multiply(outer_q, q)
    return np.concatenate([t, q], axis=1)


def main():
    names = {"lookup": lookup, "stamps": np.array(random_stamps(100_000), dtype=np.int64)}
    names["sorted_stamps"] = np.sort(names["stamps"])
    figures = {}
    for case, which in (("batch random", "stamps"), ("batch sorted", "sorted_stamps")):
        figures[case] = [value / 1e5 for value in per_call(f"lookup({which})", names)]
    report(figures)


if __name__ == "__main__":
    main()
