"""Wrong uses: mypy must refuse each line that ends in ``# no``, and no other. It is not run."""
# ruff: noqa: B018, F401

from __future__ import annotations

from typing import TYPE_CHECKING

import turtlewire
from std_msgs.msg import Bool, String
from turtlewire import errors, geometry, msg, testing
from turtlewire.bag import BagWriter, open_bag
from turtlewire.msg import deserialize_rows  # no
from turtlewire.trajectory import Trajectory, compare, plot
from turtlewire.urdf import Robot

if TYPE_CHECKING:
    from turtlewire.net import Connection


def fill(buffer: turtlewire.Buffer) -> None:
    turtlewire.Bufer()  # no
    turtlewire.Buffer(10.0)  # no
    turtlewire.Buffer(cache_time=5)  # no
    buffer.set_transform("map", "base", 1.5, (0, 0, 0))  # no
    buffer.set_transform("map", "base", (0, 0, 0))  # no
    buffer.set_transform("map", "base", 1, (0, 0, 0), static=True)  # no
    buffer.set_transform("map", "base", 1, (0, 0, 0), authority="me")  # no
    buffer.set_transform("map", "base", "now", (0, 0, 0))  # no
    buffer.set_static_transform("map", "base", 1, (0, 0, 0))  # no
    reason: str = buffer.set_transform("map", "base", 1, (0, 0, 0))  # no
    buffer.set_transforms("map", "base", [1], [[0.0] * 7], errors="ignore")  # no
    buffer.add_tf_message("text")  # no
    print(reason)


def ask(buffer: turtlewire.Buffer) -> None:
    buffer.lookup_transform("map")  # no
    buffer.lookup_transform("map", "base", 1.5)  # no
    buffer.lookup_transform("map", "base", 1, 5)  # no
    buffer.lookup_transform("map", "base", timeout_s=5)  # no
    buffer.lookup_transform("map", "base").frame_id  # no
    buffer.lookup_transform_full("map", 1, "base", 1, "odom")  # no
    buffer.lookup_transforms("map", "base")  # no
    buffer.lookup_transforms("map", "base", [1], errors="skip")  # no
    buffer.lookup_batch("map", "base", [1])  # no
    buffer.time_range("map", "base")[0]  # no
    buffer.explain("map", "base").hint  # no
    buffer.frames()["map"]  # no
    len(buffer)  # no
    turtlewire.Transform("a", "b")  # no
    turtlewire.Transform("a", "b", (0, 0, 0)) * 2  # no
    turtlewire.Transform("a", "b", (0, 0, 0)).x = 1.0  # no
    geometry.euler_from_quaternion([0, 0, 0, 1], order="xyz")  # no


def evaluate(path: str, buffer: turtlewire.Buffer) -> None:
    turtlewire.trajectory.read_tum(path)  # no
    Trajectory.load(path, format="bag")  # no
    Trajectory.load(path, "tum")  # no
    Trajectory.from_bag(path)  # no
    truth = Trajectory.load(path)
    truth.plot("pose")  # no
    truth.plot("path", truth)  # no
    compare(truth, path)  # no
    compare(truth, truth, "SE3")  # no
    compare(truth, truth, max_diff_ns=0.01)  # no
    compare(truth, truth).ape("translation")  # no
    compare(truth, truth).rpe(unit="km")  # no
    plot(truth)  # no
    plot({"a": path})  # no
    buffer.trajectory("map", "base", max_gap_ns=0.5)  # no
    truth.frame_id  # no


def record(path: str, message: msg.Message) -> None:
    with open_bag(path) as bag, BagWriter(path) as writer:
        writer.write("/chatter", "hi", log_time_ns=1)  # no
        writer.write("/chatter", message, log_time_ns=1.5)  # no
        writer.write("/chatter", message)  # no
        bag.messages(start_ns=1.5)  # no
        bag.topics()  # no
        next(bag.messages()).stamp  # no
    turtlewire.bag.load_transforms(path)  # no
    msg.deserialize(5, b"")  # no
    msg.deserialize("std_msgs/msg/String", "text")  # no
    msg.serialize("text")  # no
    msg.interface_names()  # no


def move(path: str) -> None:
    turtlewire.urdf.Kinematics(path)  # no
    robot = Robot.load()  # no
    Robot.from_xml(path, True)  # no
    robot.name = "other"  # no
    robot.transforms({"elbow": 0.5}, 5, 6)  # no
    robot.joint_names["elbow"]  # no


def talk(net: Connection) -> None:
    net.publisher("/chatter")  # no
    net.publisher("/chatter", 5)  # no
    net.publisher("/chatter", "std_msgs/msg/String").publish(1)  # no
    net.publisher("/chatter", String).publish(Bool())  # no
    next(net.subscribe("/chatter", String)).dta  # no
    net.transforms(cache_time_ns=10.0)  # no
    net.send_transform("map", "base", 1.5, (0, 0, 0))  # no
    turtlewire.connect(domain_id="3")  # no
    turtlewire.show(5)  # no
    turtlewire.show(net, "map")  # no
    turtlewire.show(net).stop()  # no
    testing.wait_for(lambda: True, timeout_s=5)  # no
    testing.wait_for(lambda: True, timeout_ns=0.5)  # no
    errors.LookupError  # no
