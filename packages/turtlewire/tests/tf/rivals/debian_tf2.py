"""Answers questions with Debian's python3-tf2.

Run by the system's Python: worlds come as JSON on stdin, answers go to stdout.
"""

import json
import sys

import rospy

import tf2_py
from geometry_msgs.msg import TransformStamped


def at(ns):
    return rospy.Time(ns // 10**9, ns % 10**9)


def stamped(parent, child, stamp, pose):
    transform = TransformStamped()
    transform.header.stamp = at(stamp)
    transform.header.frame_id = parent
    transform.child_frame_id = child
    t, q = transform.transform.translation, transform.transform.rotation
    t.x, t.y, t.z, q.x, q.y, q.z, q.w = pose
    return transform


def answer(buffer, operation):
    kind, *arguments = operation
    try:
        if kind == "common":
            return buffer.get_latest_common_time(*arguments).to_nsec()
        if kind == "lookup":
            target, source, stamp = arguments
            found = buffer.lookup_transform_core(target, source, at(stamp))
        else:
            target, target_stamp, source, source_stamp, fixed = arguments
            found = buffer.lookup_transform_full_core(
                target, at(target_stamp), source, at(source_stamp), fixed
            )
    except tf2_py.TransformException as error:
        return type(error).__name__
    t, q = found.transform.translation, found.transform.rotation
    return [found.header.stamp.to_nsec(), t.x, t.y, t.z, q.x, q.y, q.z, q.w]


def main():
    answers = []
    for operations in json.load(sys.stdin):
        buffer = tf2_py.BufferCore(rospy.Duration(10))
        for operation in operations:
            if operation[0] == "set":
                _, parent, child, stamp, pose, static = operation
                (buffer.set_transform_static if static else buffer.set_transform)(
                    stamped(parent, child, stamp, pose), "me"
                )
            elif operation[0] == "clear":
                buffer.clear()
            else:
                answers.append(answer(buffer, operation))
    json.dump(answers, sys.stdout)


if __name__ == "__main__":
    main()
