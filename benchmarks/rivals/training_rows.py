"""Rows of a training set from a bag; ours and a loop over rosbags take turns. CPU time.

The loop is the usual one: decode each message, keep what is wanted in lists, fill a transform
buffer, and for each step search the lists, interpolate and look up.
"""

import math
import random
import sys
import tempfile
from bisect import bisect_right
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2]))
sys.path.insert(0, str(Path(__file__).parents[2] / "examples" / "bag_to_lerobot"))
import numpy as np
from aligned import Wanted, align
from images import messages_of
from rosbags.highlevel import AnyReader
from rosbags.typesys import Stores, get_typestore

from benchmarks.clock import report
from benchmarks.rivals.bag_messages import measure
from rclpy.duration import Duration
from rclpy.serialization import deserialize_message
from rclpy.time import Time
from rosbag2_py import ConverterOptions, SequentialReader, StorageFilter, StorageOptions
from tf2_py import BufferCore
from turtlewire import Buffer
from turtlewire.bag import BagWriter, open_bag
from turtlewire.msg import get_message

#: A recording of an arm with two grippers, 20 frames and a camera with JPEG images.
RATES = {"/joint_states": 200, "/commands": 100, "/tf": 100, "/image": 30}
SECONDS, JOINTS, LINKS, JPEG_BYTES = 30, 14, 20, 30_000
START = 1_700_000_000 * 10**9
FPS = 30
TARGET, SOURCE = "base_link", f"link_{LINKS - 1}"


def message_of(topic, stamp, dice):
    numbers = [dice.random() for _ in range(JOINTS)]
    if topic == "/commands":
        return get_message("std_msgs/msg/Float64MultiArray")(data=numbers)
    if topic == "/tf":
        links = [link(k, stamp, dice) for k in range(LINKS)]
        return get_message("tf2_msgs/msg/TFMessage")(transforms=links)
    if topic == "/image":
        image = get_message("sensor_msgs/msg/CompressedImage")
        return stamped(image(format="jpeg", data=dice.randbytes(JPEG_BYTES)), stamp)
    names = [f"joint_{k}" for k in range(JOINTS)]
    state = get_message("sensor_msgs/msg/JointState")
    return stamped(state(name=names, position=numbers, velocity=numbers, effort=numbers), stamp)


def link(k, stamp, dice):
    made = get_message("geometry_msgs/msg/TransformStamped")(child_frame_id=f"link_{k}")
    made.header.frame_id = f"link_{k - 1}" if k else TARGET
    made.transform.translation.x, turn = dice.random(), dice.random()
    made.transform.rotation.z, made.transform.rotation.w = math.sin(turn), math.cos(turn)
    return stamped(made, stamp)


def stamped(message, stamp):
    message.header.stamp.sec, message.header.stamp.nanosec = divmod(stamp, 10**9)
    return message


def write(path, storage):
    dice = random.Random(1)
    due = sorted(
        (START + k * 10**9 // rate, topic)
        for topic, rate in RATES.items()
        for k in range(rate * SECONDS)
    )
    with BagWriter(path, storage=storage) as writer:
        for stamp, topic in due:
            writer.write(topic, message_of(topic, stamp, dice), stamp)


def recipe(path, topics):
    poses, cameras = [(TARGET, SOURCE)], {"/image": "/image"} if "/image" in topics else {}
    wanted = Wanted(FPS, "/joint_states", "/commands", ["data"], poses, cameras)
    with open_bag(path) as bag:
        rows = align(bag, wanted)
        images = [
            data
            for topic, recorded in rows.images.items()
            for data, _ in messages_of(bag, topic, recorded)
        ]
    return rows.stamps_ns, rows.state, rows.action, images


def nanoseconds(stamp):
    return stamp.sec * 10**9 + stamp.nanosec


class RosbagsLoop:
    """Messages that rosbags decodes; it has no transform buffer, so ours is filled."""

    def __init__(self):
        self.buffer = Buffer(cache_time_ns=None)

    def messages(self, path, topics):
        with AnyReader([path], default_typestore=get_typestore(Stores.ROS2_JAZZY)) as reader:
            wanted = [each for each in reader.connections if each.topic in topics]
            for connection, log_time, data in reader.messages(wanted):
                yield connection.topic, reader.deserialize(data, connection.msgtype), log_time

    def add(self, transform):
        place, turn = transform.transform.translation, transform.transform.rotation
        self.buffer.set_transform(
            transform.header.frame_id,
            transform.child_frame_id,
            nanoseconds(transform.header.stamp),
            (place.x, place.y, place.z),
            (turn.x, turn.y, turn.z, turn.w),
        )

    def pose(self, stamp):
        found = self.buffer.lookup_transform(TARGET, SOURCE, stamp)
        return *found.translation, *found.rotation


class RosLoop:
    """The program of a ROS user, with rosbag2_py, rclpy and tf2_py; on our packages."""

    def __init__(self):
        self.buffer = BufferCore(Duration(seconds=SECONDS + 1))

    def messages(self, path, topics):
        reader = SequentialReader()
        reader.open(StorageOptions(uri=str(path), storage_id=""), ConverterOptions("", ""))
        reader.set_filter(StorageFilter(topics=topics))
        types = {each.name: get_message(each.type) for each in reader.get_all_topics_and_types()}
        while reader.has_next():
            topic, data, log_time = reader.read_next()
            yield topic, deserialize_message(data, types[topic]), log_time

    def add(self, transform):
        self.buffer.set_transform(transform, "bag")

    def pose(self, stamp):
        found = self.buffer.lookup_transform_core(TARGET, SOURCE, Time(nanoseconds=stamp)).transform
        place, turn = found.translation, found.rotation
        return place.x, place.y, place.z, turn.x, turn.y, turn.z, turn.w


def decoded(path, topics, library):
    """Stamps and values of each topic; the transforms go into the library's buffer."""
    found = {topic: ([], []) for topic in RATES}
    for topic, message, log_time in library.messages(path, topics):
        stamps, values = found[topic]
        if topic == "/tf":
            for transform in message.transforms:
                library.add(transform)
        elif topic == "/commands":
            stamps.append(log_time)
            values.append(message.data)
        elif topic == "/image":
            stamps.append(nanoseconds(message.header.stamp))
            values.append(message.data)
        else:
            stamps.append(nanoseconds(message.header.stamp))
            values.append(np.asarray(message.position))
    return found.values()


def loop(path, topics, kind):
    library = kind()
    joints, (command_stamps, commands), _, (image_stamps, pixels) = decoded(path, topics, library)
    joint_stamps, positions = joints
    start = max(joint_stamps[0], command_stamps[0], *image_stamps[:1])
    end = min(joint_stamps[-1], START + (SECONDS * 100 - 1) * 10**7, *image_stamps[-1:])
    steps, states, actions, images = [], [], [], []
    for number in range((end - start) * FPS // 10**9 + 1):
        step = start + number * 10**9 // FPS
        at = min(bisect_right(joint_stamps, step), len(joint_stamps) - 1)
        share = (step - joint_stamps[at - 1]) / (joint_stamps[at] - joint_stamps[at - 1])
        joints = positions[at - 1] + (positions[at] - positions[at - 1]) * share
        steps.append(step)
        states.append([*joints, *library.pose(step)])
        actions.append(commands[bisect_right(command_stamps, step) - 1])
        if pixels:
            images.append(pixels[bisect_right(image_stamps, step) - 1])
    return np.array(steps), np.array(states), np.array(actions), images


def check(path, topics):
    """All make the same rows."""
    ours = recipe(path, topics)
    for kind in (RosbagsLoop, RosLoop):
        for mine, theirs in zip(ours, loop(path, topics, kind), strict=True):
            np.testing.assert_allclose(np.array(mine), np.array(theirs), atol=1e-9)


def main():
    figures = {}
    libraries = {
        "turtlewire": recipe,
        "rosbags": lambda path, topics: loop(path, topics, RosbagsLoop),
        "rosbag2_py": lambda path, topics: loop(path, topics, RosLoop),
    }
    numbers = [topic for topic in RATES if topic != "/image"]
    with tempfile.TemporaryDirectory(prefix="turtlewire-bench-") as name:
        for storage in ("mcap", "sqlite3"):
            path = Path(name) / storage
            write(path, storage)
            for what, topics in ((storage, numbers), (f"{storage}, images", list(RATES))):
                check(path, topics)
                found = measure(libraries, path, topics)
                figures |= {f"{what} {library}": figure for library, figure in found.items()}
    report(figures)


if __name__ == "__main__":
    main()
