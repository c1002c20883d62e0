"""Mutated bags of each kind are read as far as they can be, or refused in a sentence."""

import random
import shutil
from contextlib import suppress
from functools import partial

import pytest
from rosbags.rosbag1 import Writer as Writer1
from rosbags.rosbag2 import CompressionFormat, CompressionMode, StoragePlugin, Writer
from rosbags.typesys import Stores, get_typestore
from tests.bags import START
from tests.rosbags_messages import as_mcap, random_message, write_ros1

from turtlewire.bag import copy_bag, describe_bag, open_bag, reindex
from turtlewire.errors import TurtlewireError

pytestmark = pytest.mark.slow

JAZZY = get_typestore(Stores.ROS2_JAZZY)
ROS1 = get_typestore(Stores.ROS1_NOETIC)
NAMES = [
    "sensor_msgs/msg/Imu",
    "sensor_msgs/msg/JointState",
    "sensor_msgs/msg/PointCloud2",
    "visualization_msgs/msg/Marker",
    "std_msgs/msg/Empty",
]
EACH = 500


def write_ros2(folder, plugin, compression=False):
    writer = Writer(folder, version=9, storage_plugin=plugin)
    if compression:
        writer.set_compression(CompressionMode.STORAGE, CompressionFormat.ZSTD)
    dice = random.Random(1)
    with writer:
        for name in NAMES:
            connection = writer.add_connection(f"/{name}", name, typestore=JAZZY)
            for number in range(3):
                data = JAZZY.serialize_cdr(random_message(JAZZY, name, dice), name)
                writer.write(connection, START + number, bytes(data))
    (path,) = (each for each in folder.iterdir() if each.suffix in (".mcap", ".db3"))
    return path


def write_packed_ros1(path):
    writer = Writer1(path)
    writer.set_compression(Writer1.CompressionFormat.BZ2)
    dice = random.Random(2)
    with writer:
        for name in NAMES:
            connection = writer.add_connection(f"/{name}", name, typestore=ROS1)
            for number in range(3):
                data = ROS1.serialize_ros1(random_message(ROS1, name, dice), name)
                writer.write(connection, START + number, bytes(data))
    return path


def write_plain_ros1(path):
    write_ros1(path, ROS1, NAMES)
    return path


KINDS = {
    "mcap": lambda tmp: write_ros2(tmp / "a", StoragePlugin.MCAP),
    "mcap-zstd": lambda tmp: write_ros2(tmp / "a", StoragePlugin.MCAP, True),
    "db3": lambda tmp: write_ros2(tmp / "a", StoragePlugin.SQLITE3),
    "ros1": lambda tmp: write_plain_ros1(tmp / "a.bag"),
    "ros1-bz2": lambda tmp: write_packed_ros1(tmp / "a.bag"),
    "ros1-in-mcap": lambda tmp: as_mcap(write_plain_ros1(tmp / "a.bag"), tmp / "a.mcap"),
}


def mutated(whole, dice):
    """Bytes with a few of them changed, removed, repeated, or cut off."""
    data = bytearray(whole)
    for _ in range(dice.randint(1, 4)):
        at = dice.randrange(len(data))
        size = dice.choice([1, 1, 1, 4, 8, 200])
        way = dice.randrange(8)
        if way < 4:
            data[at : at + size] = dice.randbytes(size)
        elif way == 4:
            data[at : at + size] = b"\xff" * size
        elif way == 5:
            del data[at : at + size]
        elif way == 6:
            data[at:at] = data[at : at + size]
        elif at > len(data) // 2:
            del data[at:]
    return bytes(data)


def use(path):
    """Do what users do with a bag; return how many messages decode."""
    decoded = 0
    with open_bag(path) as bag:
        str(bag)
        topics = dict(bag.topics)
        try:
            for message in bag:
                with suppress(TurtlewireError):
                    message.decode()
                    decoded += 1
        finally:
            for name, topic in topics.items():
                if topic.type == "sensor_msgs/msg/Imu":
                    bag.columns(name, "linear_acceleration.x", "header.frame_id")
                if topic.type == "sensor_msgs/msg/PointCloud2":
                    bag.columns(name, "data")
    return decoded


@pytest.mark.parametrize("kind", KINDS)
def test_mutated_bags(tmp_path, kind):
    original = KINDS[kind](tmp_path)
    whole, dice = original.read_bytes(), random.Random(kind)
    assert use(original) == 3 * len(NAMES)
    folder = tmp_path / "bad"
    folder.mkdir()
    path = folder / f"bad_0{original.suffix}"
    outcomes = {"read": 0, "refused": 0}
    for number in range(EACH):
        path.write_bytes(mutated(whole, dice))
        actions = [partial(use, path), partial(describe_bag, path)]
        if number % 5 == 0:
            actions.append(partial(copy_bag, path, tmp_path / "copy"))
            if original.suffix != ".bag":
                actions.append(partial(reindex, folder))
        for action in actions:
            try:
                action()
                outcomes["read"] += 1
            except TurtlewireError:
                outcomes["refused"] += 1
        shutil.rmtree(tmp_path / "copy", ignore_errors=True)
        for left in folder.iterdir():
            left.unlink()
    assert min(outcomes.values()) > 20, outcomes
