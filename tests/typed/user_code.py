"""User code: every public name of the engine, as mypy must accept it. It is not run.

The last functions use names of ROS 2's Python packages.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

import turtlewire
from launch.actions import EmitEvent, ExecuteProcess
from launch.events.process import ProcessStdin
from launch_ros.actions.node import Node, NodeActionExtension, get_extensions
from launch_ros.utilities.to_parameters_list import is_node_name_matched
from rosbag2_py import MessageOrder, Player, PlayOptions, StorageOptions
from std_msgs.msg import String
from tf_transformations import (
    quaternion_about_axis,
    quaternion_matrix,
    quaternion_multiply,
    quaternion_slerp,
)
from turtlewire import errors, geometry, msg, testing
from turtlewire.bag import (
    Bag,
    BagMessage,
    BagOptions,
    BagOverview,
    BagWriter,
    Columns,
    TopicInfo,
    TopicOverview,
    TransformReport,
    WrittenBags,
    copy_bag,
    describe_bag,
    merge_bags,
    open_bag,
    reindex,
    split_bag,
)
from turtlewire.net import Connection, Publisher, Subscription
from turtlewire.net import connect as join
from turtlewire.trajectory import (
    Alignment,
    Comparison,
    Gap,
    Plot,
    PoseErrors,
    Statistics,
    Trajectory,
    compare,
    plot,
)
from turtlewire.urdf import Joint, JointLimits, Link, Material, Mesh, Mimic, Pose, Robot, UrdfError
from turtlewire.viewing import Viewer
from turtlewire.viewing import show as open_view

if TYPE_CHECKING:
    import logging
    from pathlib import Path

    from numpy.typing import NDArray

    from launch import LaunchContext

SECOND = 1_000_000_000


def fill(path: Path) -> turtlewire.Buffer:
    buffer = turtlewire.Buffer(cache_time_ns=None, max_frames=100)
    buffer.set_transform("map", "base", np.datetime64("2026-05-01T12:00:00"), (1, 2.0, 3))
    buffer.set_transform("map", "base", np.int64(5), [1, 2, 3], [0, 0, 0, 1], sender="odometry")
    buffer.set_static_transform("base", "camera", (0, 0, 1), sender="me")
    kept: int = buffer.set_transforms("map", "drone", np.arange(2), np.eye(7)[:2], errors="skip")
    stored: int = buffer.add_tf_message(b"", static=True, sender="/node")
    end = buffer.on_change(lambda: print(kept + stored))
    end()
    buffer.save(path)
    return turtlewire.Buffer.load(path)


def ask(buffer: turtlewire.Buffer, points: NDArray[np.float32]) -> str:
    found: turtlewire.Transform = buffer.lookup_transform(
        "map", "base", None, timeout_ns=SECOND, extrapolate_ns=np.timedelta64(1, "s")
    )
    moved = buffer.lookup_transform("map", "base", 5, fixed_frame="odom", target_stamp_ns=6)
    if not buffer.can_transform("map", "base", 5):
        why: errors.TransformException | None = buffer.explain("map", "base", 5)
        return "" if why is None else why.hint
    newest = buffer.lookup_newest("map", "base", max_age_ns=SECOND, now_ns=5)
    rows: NDArray[np.float64] = buffer.lookup_transforms("map", "base", [1, 2], errors="nan")
    matrices = buffer.lookup_transforms("map", "base", [1, 2], matrices=True, out=rows)
    frames, poses, stamps_ns = buffer.lookup_all("map", 5)
    speed = buffer.lookup_velocity("map", "base", 5, axes_frame="base", point=(0, 0, 1))
    cloud = buffer.transform_points("map", "lidar", points, [1, 2], errors="nan")
    both: tuple[int, int] | None = buffer.time_range("map", "base")
    print(matrices, frames, poses, stamps_ns, speed, cloud, both, newest.stamp_ns, moved.x)
    return found.source_frame


def look(buffer: turtlewire.Buffer) -> list[str]:
    for link in buffer.links():
        print(link.child_frame, link.parent_frame, link.static, link.rate_hz, link.senders)
    for problem in buffer.problems():
        print(problem.kind, problem.child_frame, problem.count, problem.text)
    for samples in buffer.samples("base"):
        print(samples.parent_frame, samples.stamps_ns, samples.poses)
    gone: list[str] = [] if buffer.is_full else buffer.remove_stale(5)
    removed: bool = buffer.remove_frame("base")
    print(buffer.to_yaml(now_ns=5), buffer.to_dot(), buffer.cache_time_ns, buffer.max_frames)
    print(removed, "base" in buffer, str(buffer), turtlewire.__version__)
    buffer.clear()
    return buffer.frames() + gone


def transform(points: NDArray[np.float64]) -> turtlewire.Transform:
    a_from_b = turtlewire.Transform("a", "b", (1, 2, 3), (0, 0, 0, 1), stamp_ns=5)
    b_from_c = turtlewire.Transform.from_matrix("b", "c", np.eye(4), stamp_ns=6)
    roll, pitch, yaw = a_from_b.euler
    x, y, z, w = a_from_b.rotation
    print(roll + pitch + yaw, x + y + z + w, a_from_b.y, a_from_b.z, a_from_b.translation[0])
    print(a_from_b.apply(points), a_from_b.as_matrix(), np.asarray(a_from_b), a_from_b.target_frame)
    return (a_from_b @ b_from_c).inverse().interpolate(b_from_c, 5)


def convert(poses: NDArray[np.float64]) -> NDArray[np.float64]:
    matrices = geometry.matrix_from_pose(poses)
    turns = geometry.quaternion_from_matrix(geometry.matrix_from_quaternion(poses[:, 3:]))
    angles = geometry.euler_from_quaternion(turns, axes=geometry.AXES[0])
    print(geometry.quaternion_from_euler(angles))
    return geometry.pose_from_matrix(matrices)


def record(path: Path, message: msg.Message) -> TransformReport | None:
    with BagWriter(path, storage="mcap", compression="zstd") as writer:
        writer.add_topic("/tf", "tf2_msgs/msg/TFMessage")
        writer.write("/chatter", message, log_time_ns=5, publish_time_ns=4)
        writer.flush()
    reindex(path)
    with open_bag(path) as bag:
        names(bag)
        for each in bag.messages(["/chatter"], types=None, start_ns=bag.start_ns):
            one: BagMessage = each
            print(
                one.topic,
                one.type,
                one.log_time_ns,
                one.publish_time_ns,
                one.decode().data,
                one.data,
            )
            print(one.upgraded_data(), msg.missing_fields(one.decode()))
        columns: Columns = bag.columns("/imu", "linear_acceleration.x", "orientation", end_ns=9)
        x: NDArray[Any] = columns["linear_acceleration.x"]
        print(x.mean(), list(columns), columns.stamps_ns, columns.to_pandas(), columns.topic)
        print(turtlewire.Buffer.from_bag(bag).bag_report)
    return turtlewire.Buffer.from_bag(path, topics="/tf", progress=print).bag_report


def edit(path: Path) -> WrittenBags:
    options: BagOptions = {"topics": "/camera/*", "rename_frames": {"odom": "robot1/odom"}}
    copy_bag(path, "minute", start="10s", end=np.datetime64("2026-01-01"))
    part = copy_bag(path, "part", **options)
    print(part.paths, part.messages, part.problems)
    split_bag(path, "pieces", every="60s", tf_at_start=True, compression="zstd")
    overview: BagOverview = describe_bag(path)
    busiest: TopicOverview = overview.topics[0]
    print(busiest.name, busiest.rate_hz, overview.duration_ns)
    return merge_bags([path, "other"], "whole", progress=print)


def names(bag: Bag) -> list[TopicInfo]:
    print(len(bag), "/tf" in bag, bag.end_ns, bag.problems, bag.path)
    return [topic for topic in bag.topics.values() if topic.message_count]


def evaluate(path: Path, buffer: turtlewire.Buffer) -> Statistics:
    estimate = buffer.trajectory("map", "base", rate_hz=10.0, max_gap_ns=SECOND)
    truth = Trajectory.load(path, format="tum")
    odometry = Trajectory.from_bag(path, "/odom", start_ns=5, max_gap_ns=np.timedelta64(1, "s"))
    odometry[1:].save(path, format="kitti")
    gaps: tuple[Gap, ...] = odometry.gaps
    run: Comparison = compare(truth, estimate, "se3", max_diff_ns=SECOND, poses_to_align=100)
    aligned: Alignment = run.alignment
    error: PoseErrors = run.rpe("angle_deg", delta=1.0, unit="m", all_pairs=True)
    picture: Plot = plot({"ape": run.ape(), "rpe": error}, "box")
    picture.save("box.svg")
    both = plot({"run": estimate}, "path", reference=truth, plane="xz")
    for drawn in (both, truth.plot("speeds", reference=estimate), run.plot("errors")):
        print(len(drawn.svg))
    print(truth.stamps_ns, truth.poses, truth.positions, truth.rotations, truth.euler, truth.timed)
    print(truth.speeds, truth.distances, truth.path_length, truth.duration_ns, truth.as_matrices())
    print(truth.target_frame, truth.source_frame, truth.to_pandas(), gaps, aligned.scale)
    print(run.reference, run.estimate, run.align, run.table("full"), error.table(), error.rows)
    return error.statistics


def move(path: Path) -> turtlewire.Buffer:
    try:
        robot = Robot.load(path)
    except UrdfError as error:
        robot = Robot.from_xml(f"<robot name='{error.line}'/>")
    joint: Joint = robot.joints["elbow"]
    limits: JointLimits | None = joint.limits
    mimic: Mimic | None = joint.mimic
    origin: Pose = joint.origin
    link: Link = robot.links[robot.root]
    meshes = [each.geometry for each in link.visuals if isinstance(each.geometry, Mesh)]
    material: Material = robot.materials["steel"]
    print(limits, mimic, origin.xyz, meshes, material.rgba, robot.name, robot.warnings, robot.xml)
    print(robot.parent_joints["hand"].name, robot.child_joints[robot.root], robot.upper)
    states = robot.clip({"elbow": [0.0, 5.0]})
    inside: bool = bool(robot.within_limits(states).all())
    print(inside, robot.joint_names, robot.link_names, robot.lower, robot.link_poses(states).shape)
    return robot.transforms({"elbow": 0.5}, stamps=[5])


def encode(folder: str) -> bytes:
    msg.add_package("my_msgs", folder)
    cls: type[msg.Message] = msg.get_message("std_msgs/msg/String")
    service: type[msg.Service[Any, Any]] = msg.get_service("std_srvs/srv/SetBool")
    action: type[msg.Action[Any, Any, Any]] = msg.get_action("turtlesim/action/RotateAbsolute")
    impl: type[msg.ActionImpl] = msg.get_action("turtlesim/action/RotateAbsolute").Impl
    data = msg.serialize(msg.get_message("std_msgs/msg/String")(data="hi"))
    print(msg.get_message("geometry_msgs/msg/Twist")().linear.x)
    print(msg.deserialize("std_msgs/msg/String", data).data.upper())
    again = msg.deserialize(cls, memoryview(data), arrays=True)
    named = msg.deserialize("std_msgs/msg/String", data)
    print(
        service,
        action,
        impl,
        again,
        named,
        msg.type_name(cls),
        msg.type_hash(cls),
        msg.interfaces(),
    )
    return data


async def listen() -> None:
    async with turtlewire.connect("one", namespace="/r1", domain_id=3, middleware="local") as net:
        async for message in net.subscribe("pose"):
            print(message.pose.position.x)
        async for text in net.subscribe("text", String):
            print(text.data.upper())


def talk(net: Connection) -> None:
    buffer = net.transforms(cache_time_ns=None, static_topic=None, forget_after_ns=SECOND)
    net.send_transform("map", "base", 5, (0, 0, 0))
    net.send_static_transform("base", "camera", (0, 0, 0), (0, 0, 0, 1))
    speaker: Publisher = net.publisher("/chatter", "std_msgs/msg/String")
    heard: Subscription = net.subscribe("/chatter", msg.get_message("std_msgs/msg/String"))
    if speaker.wait_for_subscribers(1, timeout_ns=SECOND):
        speaker.publish(data="hi")
        speaker.publish(speaker.type())
    typed: Publisher[String] = net.publisher("/text", String)
    typed.publish(typed.type(data="hi"))
    for message in heard:
        print(message, heard.latest(), heard.dropped, heard.topic, net.topics(), net.name)
        heard.close()
    speaker.close()
    print(buffer.frames(), speaker.topic)
    net.close()


def show(path: Path) -> str:
    with turtlewire.show(
        path, fixed_frame="map", config="a.rviz", port=0, lan=False, proxy=None
    ) as view:
        with join("seen", middleware="local") as net:
            talk(net)
            other: Viewer = open_view(net)
        other.wait()
        other.close()
        return view.url


def test_it() -> None:
    with testing.isolated_domain() as domain, testing.reserved_domain() as other:
        placed = testing.filled_buffer([("map", "base", (1, 0, 0))], stamp_ns=5)
        testing.wait_for(lambda: domain != other, placed, timeout_ns=SECOND)


def modules(path: Path) -> Trajectory:
    print(turtlewire.msg.interfaces(), turtlewire.errors.BagError, turtlewire.urdf.Robot)
    print(turtlewire.geometry.AXES, turtlewire.bag.open_bag, turtlewire.testing.wait_for)
    print(turtlewire.wire.open_context)
    return turtlewire.trajectory.Trajectory.load(path)


def explain(problem: Exception) -> str:
    if isinstance(problem, errors.ExtrapolationException):
        return f"{problem.reason} {problem.requested_ns} {problem.newest_ns} {problem.oldest_ns}"
    if isinstance(problem, errors.InvalidTransformError):
        return f"{problem.reason} {problem.child_frame} {problem.parent_frame} {problem.sender}"
    if isinstance(
        problem,
        (
            errors.BagError,
            errors.CdrError,
            errors.ConnectivityException,
            errors.InterfaceError,
            errors.InvalidArgumentException,
            errors.LookupException,
            errors.TimeoutException,
            errors.UncallableServiceError,
            errors.UrdfError,
            errors.WireError,
            errors.TurtlewireError,
        ),
    ):
        return problem.hint
    return ""


class Secured(NodeActionExtension):
    def prepare_for_execute(
        self, context: LaunchContext, ros_specific_arguments: dict[str, Any], node_action: Node
    ) -> tuple[list[Any], dict[str, Any]]:
        if is_node_name_matched("/robot/*", node_action.node_name):
            return ["--enclave", context.launch_configurations["enclave"]], ros_specific_arguments
        return super().prepare_for_execute(context, ros_specific_arguments, node_action)


def extended(logger: logging.Logger) -> dict[str, Any]:
    return get_extensions(logger)


def answered(process: ExecuteProcess) -> EmitEvent:
    details = process.process_details or {}
    return EmitEvent(event=ProcessStdin(text=b"y\n", action=process, **details))


def turned(net: Connection, angle: float) -> NDArray[np.float64]:
    turn = quaternion_multiply(quaternion_about_axis(angle, np.array([0, 0, 1])), [0, 0, 0, 1])
    net.send_static_transform("map", "base", np.zeros(3, np.float32), np.asarray(turn))
    turtlewire.Transform("a", "b", np.zeros(3), quaternion_slerp(np.array(turn), turn, 0.5))
    matrix: NDArray[np.float64] = quaternion_matrix(np.array(turn))
    return matrix


def play(paths: list[str]) -> bool:
    options = PlayOptions(message_order=MessageOrder.SENT_TIMESTAMP)
    return Player([StorageOptions(uri=path) for path in paths], options).play()
