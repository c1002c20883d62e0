"""Ours: turtlewire.Buffer, and the tf2_ros interface on it."""

import os
import sys
import threading
import time
from array import array

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from clock import cpu_per_item, per_call, report, summary
from world import (
    FIRST,
    LINKS_IN_MESSAGE,
    OLD,
    RECENT,
    STEP,
    arrays,
    chain,
    message,
    random_stamps,
)

import turtlewire
from turtlewire import msg


def filled():
    buffer = turtlewire.Buffer()
    for parent, child, stamp, p in chain():
        buffer.set_transform(parent, child, stamp, p[:3], p[3:])
    return buffer


def lookups(figures):
    buffer = filled()
    names = {
        "lookup": buffer.lookup_transform,
        "can": buffer.can_transform,
        "recent": RECENT,
        "old": OLD,
        "error": Exception,
    }
    figures["lookup latest"] = per_call('lookup("map", "camera")', names)
    figures["lookup interpolated"] = per_call('lookup("map", "camera", recent)', names)
    figures["lookup 9 s back"] = per_call('lookup("map", "camera", old)', names)
    figures["can_transform"] = per_call('can("map", "camera", recent)', names)
    failing = 'try:\n    lookup("map", "nobody")\nexcept error:\n    pass'
    figures["failing lookup"] = per_call(failing, names)


def batches(figures):
    import numpy as np

    buffer = filled()
    stamps = np.array(random_stamps(100_000), dtype=np.int64)
    names = {
        "batch": buffer.lookup_transforms,
        "stamps": stamps,
        "sorted_stamps": np.sort(stamps),
        "out": np.empty((100_000, 7)),
    }
    for case, which in (("batch random", "stamps"), ("batch sorted", "sorted_stamps")):
        figures[case] = [
            value / 1e5 for value in per_call(f'batch("map", "camera", {which}, out=out)', names)
        ]
    points = np.random.default_rng(1).normal(size=(100_000, 3)).astype(np.float32)
    names.update(move=buffer.transform_points, points=points, moved=np.empty_like(points))
    figures["points"] = [
        value / 1e5
        for value in per_call('move("map", "camera", points, sorted_stamps, out=moved)', names)
    ]


def memory(figures):
    from turtlewire.tf.links import links

    full = links(filled())
    figures["memory"] = [
        sum(link.memory_bytes for link in full) / sum(link.samples for link in full)
    ] * 2


def messages(figures):
    from rclpy.time import Time
    from tf2_ros.buffer import Buffer

    buffer = Buffer()
    for parent, child, stamp, p in chain():
        buffer.engine.set_transform(parent, child, stamp, p[:3], p[3:])
    names = {
        "lookup": buffer.lookup_transform,
        "latest": Time(),
        "recent": Time(nanoseconds=RECENT),
    }
    figures["message latest"] = per_call('lookup("map", "camera", latest)', names)
    figures["message interpolated"] = per_call('lookup("map", "camera", recent)', names)


def serialized(i, links):
    stamped = msg.get_message("geometry_msgs/msg/TransformStamped")
    tf_message = msg.get_message("tf2_msgs/msg/TFMessage")()
    for parent, child, stamp, p in message(i, links):
        transform = stamped(child_frame_id=child)
        transform.header.frame_id = parent
        transform.header.stamp.sec, transform.header.stamp.nanosec = divmod(stamp, 1_000_000_000)
        t, q = transform.transform.translation, transform.transform.rotation
        t.x, t.y, t.z, q.x, q.y, q.z, q.w = p
        tf_message.transforms.append(transform)
    return msg.serialize(tf_message)


def ingest(figures):
    """Each message is made just before it is taken, as one that has just come from the wire."""
    for case, links, cache in (
        ("1 a message", 1, 10**10),
        ("hot", LINKS_IN_MESSAGE, 10**8),
        ("cold", LINKS_IN_MESSAGE, 10**10),
    ):
        buffer = turtlewire.Buffer(cache)
        warm = 10_500 if cache == 10**10 else 1000
        for i in range(warm):
            for parent, child, stamp, p in message(i, links):
                buffer.set_transform(parent, child, stamp, p[:3], p[3:])
        step, runs = 1000 // links, []
        for start in range(warm, warm + 60 * step, step):
            data = [serialized(i, links) for i in range(start, start + step)]
            begin = time.perf_counter_ns()
            for cdr in data:
                buffer.add_tf_message(cdr)
            runs.append((time.perf_counter_ns() - begin) / step / links)
        figures["ingest " + case] = summary(runs)


def array_ingest(count):
    stamps, poses = arrays(count)
    return cpu_per_item(
        lambda buffer: buffer.set_transforms("map", "odom", stamps, poses),
        lambda: turtlewire.Buffer(None),
        count,
    )


def wake_up(figures):
    """From the arrival of the data to the return of the lookup that waited for it, in another
    thread.
    """
    buffer, latencies = turtlewire.Buffer(), []
    identity = ((0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 1.0))
    asked, done = threading.Semaphore(0), threading.Semaphore(0)
    times = array("q", [0, 0])

    def wait():
        for i in range(1, 301):
            asked.release()
            buffer.lookup_transform("a", "b", FIRST + i * STEP, timeout_ns=60 * 10**9)
            times[1] = time.perf_counter_ns()
            done.release()

    waiter = threading.Thread(target=wait)
    waiter.start()
    for i in range(1, 301):
        asked.acquire()
        time.sleep(0.003)  # long enough for the waiter to be asleep
        times[0] = time.perf_counter_ns()
        buffer.set_transform("a", "b", FIRST + i * STEP, *identity)
        done.acquire()
        latencies.append(times[1] - times[0])
    waiter.join()
    figures["wake-up of a waiting lookup"] = summary(latencies)


def main():
    figures = {}
    for part in (lookups, batches, memory, messages, ingest, wake_up):
        part(figures)
    for count in (100_000, 1_000_000):
        figures[f"arrays of {count}"] = array_ingest(count)
    report(figures)


if __name__ == "__main__":
    main()
