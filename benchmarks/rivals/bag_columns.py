"""Fields of a topic as NumPy arrays; ours and a loop over rosbags take turns. CPU time."""

import random
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2]))
import numpy as np
from rosbags.highlevel import AnyReader
from rosbags.typesys import Stores, get_typestore

from benchmarks.clock import report
from benchmarks.rivals.bag_messages import measure
from benchmarks.robot_bag import START, message_of, write_ros1_bag
from turtlewire.bag import BagWriter, open_bag

#: Type and number of messages of each topic, the field, and how a loop reads it.
TOPICS = {
    "/imu": (
        "sensor_msgs/msg/Imu",
        50_000,
        "linear_acceleration.x",
        lambda m: m.linear_acceleration.x,
    ),
    "/odom": (
        "nav_msgs/msg/Odometry",
        50_000,
        "pose.pose.position",
        lambda m: (m.pose.pose.position.x, m.pose.pose.position.y, m.pose.pose.position.z),
    ),
    "/scan": ("sensor_msgs/msg/LaserScan", 2_000, "ranges", lambda m: m.ranges),
    "/points": ("sensor_msgs/msg/PointCloud2", 200, "data", lambda m: m.data),
    "/image": ("sensor_msgs/msg/Image", 200, "data", lambda m: m.data),
}


def write(path, topic, storage):
    """Write a bag of one topic."""
    type_name, count, _, _ = TOPICS[topic]
    dice = random.Random(1)
    with BagWriter(path, storage=storage) as writer:
        for k in range(count):
            stamp = START + k * 5_000_000
            writer.write(topic, message_of(type_name, stamp, dice), stamp)


def turtlewire(path, topic):
    with open_bag(path) as bag:
        return bag.columns(topic, TOPICS[topic][2])


def rosbags(path, topic):
    get, stamps, values = TOPICS[topic][3], [], []
    with AnyReader([path], default_typestore=get_typestore(Stores.ROS2_JAZZY)) as reader:
        for connection, _, data in reader.messages():
            message = reader.deserialize(data, connection.msgtype)
            stamp = message.header.stamp
            stamps.append(stamp.sec * 10**9 + stamp.nanosec)
            values.append(get(message))
    return np.array(stamps), values if topic in ("/points", "/image") else np.array(values)


def copier(path, topic):
    """Return a function that only copies as many bytes as the messages of a bag have."""
    with open_bag(path) as bag:
        messages = [bytearray(message.data) for message in bag.messages(topic)]
    return lambda *_: [bytes(message) for message in messages]


def main():
    figures = {}
    libraries = {"turtlewire": turtlewire, "rosbags": rosbags}
    for topic in TOPICS:
        with tempfile.TemporaryDirectory(prefix="turtlewire-bench-") as name:
            folder = Path(name)
            write(folder / "mcap", topic, "mcap")
            write(folder / "sqlite3", topic, "sqlite3")
            write_ros1_bag(folder / "mcap", folder / "ros1.bag")
            libraries["copy"] = copier(folder / "mcap", topic)
            for bag in ("mcap", "sqlite3", "ros1.bag"):
                for library, figure in measure(libraries, folder / bag, topic).items():
                    figures[f"{topic} {bag} {library}"] = figure
    report(figures)


if __name__ == "__main__":
    main()
