"""Debian's python3-tf2: the C++ tf2 of ROS 1 behind its tf2_py, with its message classes.

Run by the system's Python.
"""

import os
import sys
import time
from io import BytesIO

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
import rospy
from clock import per_call, report, summary
from world import LINKS_IN_MESSAGE, OLD, RECENT, chain, message, random_stamps

import tf2_py
from geometry_msgs.msg import TransformStamped
from tf2_msgs.msg import TFMessage


def stamped(parent, child, stamp, p):
    transform = TransformStamped()
    transform.header.stamp = rospy.Time(stamp // 10**9, stamp % 10**9)
    transform.header.frame_id = parent
    transform.child_frame_id = child
    t, q = transform.transform.translation, transform.transform.rotation
    t.x, t.y, t.z, q.x, q.y, q.z, q.w = p
    return transform


def at(stamp):
    return rospy.Time(stamp // 10**9, stamp % 10**9)


def lookups(figures):
    buffer = tf2_py.BufferCore(rospy.Duration(10))
    for sample in chain():
        buffer.set_transform(stamped(*sample), "default_authority")
    names = {
        "lookup": buffer.lookup_transform_core,
        "can": buffer.can_transform_core,
        "error": Exception,
    }
    names.update(
        latest=rospy.Time(0),
        recent=at(RECENT),
        old=at(OLD),
        stamps=[at(stamp) for stamp in random_stamps(1000)],
    )
    figures["lookup latest"] = per_call('lookup("map", "camera", latest)', names)
    figures["lookup interpolated"] = per_call('lookup("map", "camera", recent)', names)
    figures["lookup 9 s back"] = per_call('lookup("map", "camera", old)', names)
    figures["can_transform"] = per_call('can("map", "camera", recent)', names)
    figures["failing lookup"] = per_call(
        'try:\n    lookup("map", "nobody", latest)\nexcept error:\n    pass', names
    )
    many = per_call('for t in stamps: lookup("map", "camera", t)', names)
    figures["lookup, random stamps"] = [value / 1000 for value in many]


def serialized(i, links):
    out = BytesIO()
    TFMessage([stamped(*sample) for sample in message(i, links)]).serialize(out)
    return out.getvalue()


def ingest(figures):
    for case, links, cache in (
        ("1 a message", 1, 10),
        ("hot", LINKS_IN_MESSAGE, 0.1),
        ("cold", LINKS_IN_MESSAGE, 10),
    ):
        buffer = tf2_py.BufferCore(rospy.Duration.from_sec(cache))
        warm = 10_500 if cache == 10 else 1000
        for i in range(warm):
            for sample in message(i, links):
                buffer.set_transform(stamped(*sample), "default_authority")
        step, runs = 200 // links, []
        for start in range(warm, warm + 40 * step, step):
            data = [serialized(i, links) for i in range(start, start + step)]
            begin = time.perf_counter_ns()
            for received in data:
                for transform in TFMessage().deserialize(received).transforms:
                    buffer.set_transform(transform, "default_authority")
            runs.append((time.perf_counter_ns() - begin) / step / links)
        figures["ingest " + case] = summary(runs)


def main():
    figures = {}
    lookups(figures)
    ingest(figures)
    report(figures)


if __name__ == "__main__":
    main()
