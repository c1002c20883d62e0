"""transform-tree (`import tf_tree`): interpolated linearly and by SLERP, as tf2 does."""

import itertools
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
import numpy as np
import tf_tree
from clock import cpu_per_item, per_call, report
from world import FIRST, FRAMES, RECENT, SAMPLES, STEP, arrays, pose, random_stamps


def filled():
    edges = list(itertools.pairwise(FRAMES))
    tree = tf_tree.build(edges, capacity=2 * SAMPLES, interp="lerpslerp")
    stamps = np.arange(SAMPLES, dtype=np.int64) * STEP + FIRST
    for link, (parent, child) in enumerate(edges):
        poses = np.array([pose(link, i) for i in range(SAMPLES)])
        poses = np.ascontiguousarray(poses[:, [6, 3, 4, 5, 0, 1, 2]])
        with tree.publisher(child, parent) as publisher:
            publisher.push_many(stamps, poses)
    return tree


def store(tree, stamps, poses):
    with tree.publisher("odom", "map") as publisher:
        publisher.push_many(stamps, poses)


def array_ingest(count):
    stamps, poses = arrays(count)
    poses = np.ascontiguousarray(poses[:, [6, 3, 4, 5, 0, 1, 2]])
    return cpu_per_item(
        lambda tree: store(tree, stamps, poses),
        lambda: tf_tree.build([("map", "odom")], capacity=count, interp="lerpslerp"),
        count,
    )


def main():
    tree = filled()
    stamps = np.array(random_stamps(100_000), dtype=np.int64)
    names = {
        "tree": tree,
        "recent": RECENT,
        "plan": tree.plan("map", "camera"),
        "stamps": stamps,
        "sorted_stamps": np.sort(stamps),
    }
    figures = {
        "lookup latest": per_call("plan.latest()", names),
        "lookup interpolated": per_call('tree.lookup("map", "camera", recent)', names),
    }
    for case, which in (("batch random", "stamps"), ("batch sorted", "sorted_stamps")):
        values = per_call(f'plan.at({which}, layout="quat")', names)
        figures[case] = [value / len(stamps) for value in values]
    for count in (100_000, 1_000_000):
        figures[f"arrays of {count}"] = array_ingest(count)
    report(figures)


if __name__ == "__main__":
    main()
