"""Calls that users get wrong: each text says what was given, what exists and what to do."""

import os
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

import turtlewire
from turtlewire import msg
from turtlewire.bag import BagWriter, copy_bag, merge_bags, open_bag
from turtlewire.trajectory import Trajectory, compare, plot
from turtlewire.urdf import Robot

SECOND = 1_000_000_000
START = 1_700_000_000 * SECOND
URDF = """<robot name="arm"><link name="base"/><link name="arm"/><link name="hand"/>
<joint name="elbow" type="revolute"><parent link="base"/><child link="arm"/><axis xyz="0 1 0"/>
<limit lower="-2" upper="2" effort="1" velocity="1"/></joint>
<joint name="wrist" type="fixed"><parent link="arm"/><child link="hand"/></joint></robot>"""
XACRO = """<robot name="a" xmlns:xacro="http://www.ros.org/wiki/xacro">
<xacro:property name="w" value="1"/>{}</robot>"""


@pytest.fixture(scope="module")
def at(tmp_path_factory):
    """Return what the calls are made with."""
    home = tmp_path_factory.mktemp("home")
    string = msg.get_message("std_msgs/msg/String")
    with BagWriter(home / "drive") as writer:
        for second in range(3):
            writer.write("/chat", string(data="hi"), START + second * SECOND)
    for name, text in {
        "arm.urdf": URDF,
        "link.xacro": XACRO.format('<link name="l_${w}"/>'),
        "empty.xacro": XACRO.format(""),
        "arm.sdf": "<sdf/>",
        "seconds.csv": "t_ns,x,y,z,qx,qy,qz,qw\n0.5,1,0,0,0,0,0,1\n",
        "good.tum": "0 0 0 0 0 0 0 1\n",
    }.items():
        (home / name).write_text(text)
    (home / "nothing").mkdir()
    stamps, poses = np.arange(5) * SECOND, np.zeros((5, 7))
    poses[:, 0], poses[:, 6] = np.arange(5), 1
    path = Trajectory(stamps, poses)
    bag = open_bag(home / "drive")
    writer = BagWriter(home / "writing")
    writer.write("/chat", string(), START)
    robot = Robot.load(home / "arm.urdf")
    run = compare(path, path)
    yield SimpleNamespace(**locals())
    writer.close()
    bag.close()


def nan_at(poses):
    known = poses.copy()
    known[3, 0] = np.nan
    return known


MISTAKES = [
    # Paths
    (lambda at: open_bag(at.home / "driev"), FileNotFoundError, "did you mean '.*drive'?"),
    (lambda at: open_bag(at.home / "no" / "drive"), FileNotFoundError, "folder .*no does not"),
    (lambda at: open_bag("~/drive"), FileNotFoundError, "os.path.expanduser"),
    (lambda at: open_bag(""), ValueError, "path is empty; pass the path of a bag"),
    (lambda at: open_bag([at.home]), TypeError, "not list; pass one path at a time"),
    (lambda at: open_bag(at.bag), TypeError, "not Bag; pass its attribute `path`"),
    (lambda at: open_bag(at.home / "nothing"), turtlewire.errors.BagError, "is not a bag"),
    (lambda at: BagWriter(""), ValueError, "path is empty"),
    (lambda at: Robot.load(at.home / "amr.urdf"), FileNotFoundError, "did you mean '.*arm.urdf'"),
    (lambda at: Robot.load(at.home), IsADirectoryError, "it contains arm.urdf"),
    (lambda at: Robot.load("package://arm/a.urdf"), FileNotFoundError, "not a URL"),
    (lambda at: Robot.load(3), TypeError, "path must be a str or pathlib.Path, not int"),
    (lambda at: Trajectory.load(at.home / "godo.tum"), FileNotFoundError, "did you mean '.*good"),
    (lambda at: Trajectory.load(None), TypeError, "path must be a str or pathlib.Path"),
    (lambda at: at.path.save(None), TypeError, "path must be a str or pathlib.Path"),
    # Robots
    (lambda at: Robot(at.home), TypeError, r"Robot.load\(path\)"),
    (lambda at: at.robot.link_poses({"hand": 1}), KeyError, "joint above it is 'wrist'"),
    (lambda at: at.robot.link_poses({"wrist": 1}), KeyError, "'wrist' is fixed"),
    (lambda at: at.robot.link_poses(None), TypeError, "dict by name of the joint"),
    (lambda at: at.robot.link_poses([{"elbow": 1}]), TypeError, "not a list of dicts; write"),
    (lambda at: at.robot.link_poses(np.zeros((2, 3))), ValueError, "dict by name"),
    (lambda at: at.robot.link_poses({"elbow": 90}), UserWarning, "beyond its limits.*np.radians"),
    (lambda at: at.robot.transforms({}, stamps_ns=1), TypeError, "did you mean 'stamps'"),
    # Bags
    (lambda at: list(at.bag.messages(b"/chat")), TypeError, "topics must be a str.*not bytes"),
    (lambda at: list(at.bag.messages(5)), TypeError, "topics must be a str or several, not int"),
    (lambda at: list(at.bag.messages(types=at.string)), TypeError, "not the class String"),
    (lambda at: list(at.bag.messages(types="a/msg/B")), turtlewire.errors.BagError, "of the type"),
    (lambda at: list(at.bag.messages(start=1)), TypeError, "did you mean 'start_ns'"),
    (lambda at: list(at.bag.messages(start_ns=START // SECOND)), ValueError, "since 1970"),
    (lambda at: list(at.bag.messages(end_ns=2 * SECOND)), ValueError, "bag.start_ns"),
    (lambda at: list(at.bag.messages(start_ns=1.5)), TypeError, r"round\(seconds \* 1e9\)"),
    (lambda at: copy_bag(at.bag.path, "x", start=2), ValueError, "start is 2, but the bag"),
    (lambda at: copy_bag(at.bag.path, "x", end=2.0), TypeError, "end must be an int"),
    (lambda at: copy_bag(at.bag.path, "x", rename_frames="a"), TypeError, "must be a dict"),
    (lambda at: copy_bag(at.bag.path, "x", zzz="a"), TypeError, "The options are start, end"),
    (lambda at: merge_bags(at.bag.path, "x"), TypeError, "takes a list of bags"),
    (lambda at: at.writer.write("/chat", at.string(), 1 << 64), ValueError, "more nanoseconds"),
    (lambda at: at.writer.write(None, at.string(), 1), TypeError, "topic must be str"),
    (lambda at: at.writer.write("/chat", np.zeros(3), 1), TypeError, "not ndarray"),
    (lambda at: at.writer.write("/chat", at.string, 1), TypeError, r"write String\(\)"),
    (lambda at: at.writer.write("/chat", {"data": ""}, 1), TypeError, r"\(\*\*fields\)"),
    (lambda at: at.writer.write("/tf", [1], 1), TypeError, r"TFMessage\(transforms="),
    (lambda at: at.writer.add_topic("/n", at.string), TypeError, "write 'std_msgs/msg/String'"),
    (lambda at: Trajectory.from_bag(at.bag.path), TypeError, "missing 1 .*'topic'; it takes path"),
    # Trajectories
    (lambda at: Trajectory.load(at.home / "seconds.csv"), ValueError, "not a whole number"),
    (lambda at: Trajectory(at.poses, at.stamps), TypeError, "stamps come before the poses"),
    (lambda at: Trajectory(at.stamps[::-1], at.poses), ValueError, r"np.unique\("),
    (lambda at: Trajectory(at.stamps, at.poses[:, :3]), ValueError, "np.hstack"),
    (lambda at: Trajectory(at.stamps, np.ones((5, 8))), ValueError, r"poses\[:, 1:\]"),
    (lambda at: Trajectory(at.stamps, np.ones((5, 4, 4))), ValueError, "pose_from_matrix"),
    (lambda at: Trajectory(at.stamps, nan_at(at.poses)), ValueError, "pose 3 .* not finite"),
    (lambda at: Trajectory(at.stamps, at.poses * 1j), TypeError, "array of numbers"),
    (lambda at: Trajectory("a.tum"), TypeError, "'poses'; it takes stamps_ns, poses"),
    (lambda at: compare(at.path, Trajectory(np.arange(5), at.poses)), ValueError, "in.* seconds"),
    (lambda at: compare(at.path, at.path, max_diff_ns=-1), ValueError, "not be negative"),
    (lambda at: compare(at.path, at.path, max_diff=1), TypeError, "did you mean 'max_diff_ns'"),
    (lambda at: at.run.ape("point_distance_error_ratio"), ValueError, r"measured by rpe\(\)"),
    (lambda at: at.run.rpe(delta="10m"), TypeError, "delta=10, unit='m'"),
    (lambda at: at.run.plot("box"), ValueError, r"plot\({name: comparison.ape\(\)}"),
    (lambda at: at.run.ape().rmse, AttributeError, "use statistics"),
    (lambda at: at.run.rmse, AttributeError, r"use ape\(\).statistics"),
    (lambda at: at.path.plot().show(), AttributeError, r"use save\(path\)"),
    (lambda at: at.path.plot(reference=at.poses), TypeError, "must be a Trajectory, not ndarray"),
    # Messages
    (lambda at: msg.get_message("std_msgs.msg.String"), LookupError, "not the name"),
    (lambda at: msg.String, AttributeError, r"get_message\('std_msgs/msg/String'\)"),
    (lambda at: msg.serialize({"data": ""}), TypeError, r"get_message\(type\)\(\*\*fields\)"),
    (lambda at: msg.serialize(at.string), TypeError, r"the class String; write String\(\)"),
    (lambda at: msg.serialize(at.string(data=5)), ValueError, "expected str, got int"),
    (lambda at: msg.deserialize(at.string, "hello"), TypeError, "data must be bytes, not str"),
    (lambda at: msg.deserialize(at.string, [0]), TypeError, "data must be bytes, not list"),
    (lambda at: msg.deserialize(at.string, next(iter(at.bag))), TypeError, r"call its decode\(\)"),
    (lambda at: msg.deserialize(b"", "std_msgs/msg/String"), TypeError, "name first"),
    (
        lambda at: msg.get_message("sensor_msgs/msg/Image")(data=["a"]),
        TypeError,
        "sensor_msgs/msg/Image: field 'data' holds a sequence of numbers",
    ),
    (lambda at: msg.add_package("my_msgs", "nowhere"), NotADirectoryError, "nowhere is not a"),
    (lambda at: msg.add_package("my_msgs", at.home / "nothing"), LookupError, "none of the fold"),
    (lambda at: msg.add_package("my msgs", "nowhere"), LookupError, "not the name of a package"),
    # Networks
    (lambda at: turtlewire.connect("my node"), ValueError, "'my node': node name must not"),
    (lambda at: turtlewire.connect("a", domain=7), TypeError, "did you mean 'domain_id'"),
    (lambda at: turtlewire.show(frame="map"), TypeError, "did you mean 'fixed_frame'"),
]


@pytest.mark.parametrize(("call", "kind", "text"), MISTAKES)
def test_the_error_says_what_to_do(at, call, kind, text):
    with pytest.raises(kind, match=text) as error:
        call(at)
    assert len(str(error.value)) < 300
    assert error.value.__cause__ is None
    assert error.value.__context__ is None or error.value.__suppress_context__


@pytest.mark.parametrize(
    ("call", "hint"),
    [
        (lambda at: Robot.load(at.home / "link.xacro"), "xacro .*link.xacro > robot.urdf"),
        (lambda at: Robot.load(at.home / "empty.xacro"), "xacro .*empty.xacro > robot.urdf"),
        (lambda at: Robot.load(at.home / "arm.sdf"), "arm.sdf, line 1 in <sdf>. It is SDF"),
        (lambda at: open_bag(at.home), "Bags in it: .*drive"),
        (lambda at: msg.get_message("std_msgs.msg.String"), "Write 'std_msgs/msg/String'"),
        (lambda at: msg.get_message("/std_msgs/msg/String"), "Write 'std_msgs/msg/String'"),
        (lambda at: msg.get_message("foreign_msgs/msg/Foo"), "add_package.'foreign_msgs'"),
        (lambda at: msg.get_message("std_srvs/srv/Empty"), "msg.get_service"),
    ],
)
def test_the_hint_says_what_to_do(at, call, hint):
    import re

    with pytest.raises(turtlewire.errors.TurtlewireError) as error:
        call(at)
    assert re.search(hint, error.value.hint)


def test_mistakes_of_a_connection():
    with turtlewire.connect("mistaken", middleware="local") as net:
        for call, kind, text in (
            (lambda: net.publisher("//x", "std_msgs/msg/String"), ValueError, "repeated '/'"),
            (lambda: net.publisher("/x", "std_msgs/msg/String", qos=10), TypeError, "QoS.depth"),
            (lambda: net.subscribe("/x", print), TypeError, "takes no callback"),
            (lambda: net.lookup_transform("a", "b"), AttributeError, r"use transforms\(\)"),
            (lambda: net.subscribe("/x").get(), AttributeError, "for message in subscription"),
        ):
            with pytest.raises(kind, match=text):
                call()
        talk = net.publisher("/x", "std_msgs/msg/String")
        with pytest.raises(TypeError, match="has no field 'dat'; did you mean 'data'"):
            talk.publish(dat="x")
        with pytest.raises(TypeError, match="called with the class String"):
            talk.publish(talk.type)
    for use in (net.topics, net.__enter__):
        with pytest.raises(turtlewire.errors.WireError, match="is closed"):
            use()


@pytest.mark.parametrize("storage", ["mcap", "sqlite3"])
def test_a_time_that_is_refused_leaves_the_bag_whole(tmp_path, storage):
    message = msg.get_message("std_msgs/msg/String")()
    with BagWriter(tmp_path / "bag", storage=storage) as writer:
        last = (1 << (64 if storage == "mcap" else 63)) - 1
        with pytest.raises(ValueError, match="more nanoseconds than a bag can store"):
            writer.write("/chat", message, last + 1)
        writer.write("/chat", message, last)
    with open_bag(tmp_path / "bag") as bag:
        assert [each.log_time_ns for each in bag] == [last]


def test_paths_may_be_bytes(tmp_path):
    (tmp_path / "a.urdf").write_text(URDF)
    assert Robot.load(os.fsencode(tmp_path / "a.urdf")).name == "arm"
    assert Robot.load(Path(tmp_path / "a.urdf")).name == "arm"
    BagWriter(os.fsencode(tmp_path / "bag")).close()
    assert open_bag(os.fsencode(tmp_path / "bag")).path == str(tmp_path / "bag")


def test_columns_of_a_heading_decide_the_order_of_the_quaternion(tmp_path):
    for columns in ("qw,qx,qy,qz", "q_w,q_x,q_y,q_z", "qx,qy,qz,qw"):
        numbers = "0,0,0,1" if columns.endswith("w") else "1,0,0,0"
        (tmp_path / "a.csv").write_text(f"#timestamp,x,y,z,{columns}\n1000000000,0,0,0,{numbers}\n")
        assert Trajectory.load(tmp_path / "a.csv").rotations.tolist() == [[0, 0, 0, 1]]


def test_integer_seconds_in_a_file_are_reported(tmp_path):
    rows = [f"{1_700_000_000 + i},{i},0,0,0,0,0,1\n" for i in range(3)]
    (tmp_path / "a.csv").write_text("t_ns,x,y,z,qx,qy,qz,qw\n" + "".join(rows))
    with pytest.warns(UserWarning, match="stamps such as 1700000000 are read as nanoseconds"):
        Trajectory.load(tmp_path / "a.csv")


def test_errors_are_drawn_as_boxes_by_default():
    poses = np.tile([0.0, 0, 0, 0, 0, 0, 1], (3, 1))
    path = Trajectory(np.arange(3) * SECOND, poses)
    errors = compare(path, path).ape()
    assert plot({"a": errors}).svg == plot({"a": errors}, "box").svg


def test_limits_that_a_urdf_does_not_give_are_not_exceeded(recwarn):
    Robot.from_xml(URDF.replace('lower="-2" upper="2" ', "")).link_poses({"elbow": 90})
    assert not recwarn.list


def test_degrees_are_reported_only_beyond_a_turn_and_the_limits(recwarn):
    robot = Robot.from_xml(URDF)
    robot.link_poses({"elbow": 6.28})
    robot.link_poses({"elbow": np.linspace(-6.28, 6.28, 5)})
    assert not recwarn.list
    with pytest.warns(UserWarning, match="the position -90 of the joint 'elbow'"):
        robot.transforms({"elbow": [0, -90]}, [0, 1])


def test_pandas_is_named_if_it_is_missing(monkeypatch):
    monkeypatch.setitem(__import__("sys").modules, "pandas", None)
    path = Trajectory([0], [[0, 0, 0, 0, 0, 0, 1]])
    with pytest.raises(ModuleNotFoundError, match="pip install pandas"):
        path.to_pandas()
