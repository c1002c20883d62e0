"""The bag of a robot with many sensors, as MCAP, sqlite3 and a bag of ROS 1."""

import random
import sys
from contextlib import redirect_stdout

#: Messages a second of each topic, with the type.
TOPICS = {
    "/imu": (400, "sensor_msgs/msg/Imu"),
    "/joint_states": (100, "sensor_msgs/msg/JointState"),
    "/tf": (100, "tf2_msgs/msg/TFMessage"),
    "/odom": (100, "nav_msgs/msg/Odometry"),
    "/cmd_vel": (50, "geometry_msgs/msg/Twist"),
    "/pose": (50, "geometry_msgs/msg/PoseWithCovarianceStamped"),
    "/scan": (20, "sensor_msgs/msg/LaserScan"),
    "/points": (10, "sensor_msgs/msg/PointCloud2"),
    "/image": (10, "sensor_msgs/msg/Image"),
    "/camera_info": (10, "sensor_msgs/msg/CameraInfo"),
    "/fix": (10, "sensor_msgs/msg/NavSatFix"),
    "/plan": (2, "nav_msgs/msg/Path"),
    "/markers": (2, "visualization_msgs/msg/MarkerArray"),
    "/diagnostics": (2, "diagnostic_msgs/msg/DiagnosticArray"),
}
SECONDS = 20
START = 1_700_000_000 * 10**9
JOINTS, LINKS, RANGES, POINTS, POSES, MARKERS = 12, 6, 720, 5000, 200, 20
SIZE = (320, 240)


def write_robot_bag(path, storage="mcap"):
    """Write the bag of ROS 2."""
    from turtlewire.bag import BagWriter

    dice = random.Random(1)
    with BagWriter(path, storage=storage) as writer:
        due = sorted(
            (START + k * 10**9 // rate, topic, type_name)
            for topic, (rate, type_name) in TOPICS.items()
            for k in range(rate * SECONDS)
        )
        for stamp, topic, type_name in due:
            writer.write(topic, message_of(type_name, stamp, dice), stamp)


def write_ros1_bag(source, target):
    """Write the messages of a bag of ROS 2 as a bag of ROS 1."""
    from pathlib import Path

    from rosbags.convert import convert
    from rosbags.typesys import Stores, get_typestore

    with redirect_stdout(sys.stderr):  # it prints what it does
        convert(
            [Path(source)],
            Path(target),
            dst_storage=None,
            dst_version=None,
            compress=None,
            compress_mode="none",
            default_typestore=get_typestore(Stores.ROS2_JAZZY),
            typestore=get_typestore(Stores.ROS1_NOETIC),
            exclude_topics=(),
            include_topics=(),
            exclude_msgtypes=(),
            include_msgtypes=(),
        )


def message_of(type_name, stamp_ns, dice):
    """Return a message of a type with plausible content."""
    from turtlewire.msg import get_message

    message = get_message(type_name)()
    fill = _FILL.get(type_name.rpartition("/")[2])
    if fill is not None:
        fill(message, stamp_ns, dice)
    if hasattr(message, "header"):
        _stamp(message.header, stamp_ns)
    return message


def _stamp(header, stamp_ns):
    header.stamp.sec, header.stamp.nanosec = divmod(stamp_ns, 10**9)
    header.frame_id = header.frame_id or "base_link"


def _new(type_name):
    from turtlewire.msg import get_message

    return get_message(type_name)()


def _vector(vector, dice):
    vector.x, vector.y, vector.z = dice.random(), dice.random(), dice.random()


def _imu(message, _, dice):
    _vector(message.linear_acceleration, dice)
    _vector(message.angular_velocity, dice)


def _joint_states(message, _, dice):
    message.name = [f"joint_{k}" for k in range(JOINTS)]
    for field in ("position", "velocity", "effort"):
        setattr(message, field, [dice.random() for _ in range(JOINTS)])


def _transforms(message, stamp_ns, dice):
    for k in range(LINKS):
        transform = _new("geometry_msgs/msg/TransformStamped")
        _stamp(transform.header, stamp_ns)
        transform.child_frame_id = f"link_{k}"
        _vector(transform.transform.translation, dice)
        message.transforms.append(transform)


def _odometry(message, _, dice):
    message.child_frame_id = "base_link"
    _vector(message.pose.pose.position, dice)
    _vector(message.twist.twist.linear, dice)


def _twist(message, _, dice):
    _vector(message.linear, dice)


def _scan(message, _, dice):
    message.ranges = [dice.random() for _ in range(RANGES)]
    message.intensities = [dice.random() for _ in range(RANGES)]


def _cloud(message, _, dice):
    message.height, message.width, message.point_step = 1, POINTS, 16
    message.row_step = POINTS * 16
    for k, name in enumerate(("x", "y", "z", "intensity")):
        field = _new("sensor_msgs/msg/PointField")
        field.name, field.offset, field.datatype, field.count = name, 4 * k, 7, 1
        message.fields.append(field)
    message.data = dice.randbytes(POINTS * 16)


def _image(message, _, dice):
    message.width, message.height = SIZE
    message.encoding, message.step = "rgb8", 3 * SIZE[0]
    message.data = dice.randbytes(3 * SIZE[0] * SIZE[1])


def _path(message, stamp_ns, dice):
    for _ in range(POSES):
        pose = _new("geometry_msgs/msg/PoseStamped")
        _stamp(pose.header, stamp_ns)
        _vector(pose.pose.position, dice)
        message.poses.append(pose)


def _markers(message, stamp_ns, dice):
    for k in range(MARKERS):
        marker = _new("visualization_msgs/msg/Marker")
        _stamp(marker.header, stamp_ns)
        marker.id, marker.ns = k, "obstacles"
        _vector(marker.scale, dice)
        marker.points = [_new("geometry_msgs/msg/Point") for _ in range(8)]
        message.markers.append(marker)


def _diagnostics(message, _, dice):
    for k in range(5):
        status = _new("diagnostic_msgs/msg/DiagnosticStatus")
        status.name, status.message = f"motor {k}", "OK"
        value = _new("diagnostic_msgs/msg/KeyValue")
        value.key, value.value = "temperature", f"{dice.random():.3f}"
        status.values = [value] * 4
        message.status.append(status)


_FILL = {
    "Imu": _imu,
    "JointState": _joint_states,
    "TFMessage": _transforms,
    "Odometry": _odometry,
    "Twist": _twist,
    "LaserScan": _scan,
    "PointCloud2": _cloud,
    "Image": _image,
    "Path": _path,
    "MarkerArray": _markers,
    "DiagnosticArray": _diagnostics,
}
