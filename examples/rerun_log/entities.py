"""Logs ROS 2's messages as entities of Rerun.

A transform has the entity ``tf/CHILD`` and the names of both frames. Another message has the entity
of its topic, in the frame of its header. The timeline ``stamp`` has the stamps of all.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import rerun as rr

from turtlewire import Buffer, msg

if TYPE_CHECKING:
    from turtlewire.bag import Bag

AXES = 0.1  # the length of the axes of a frame, in metres
IMAGES = 0.5  # the distance of an image from its camera, in metres
#: The colours of encodings of 8 bits; images with others are left out.
COLOURS = {"rgb8": "RGB", "bgr8": "BGR", "rgba8": "RGBA", "bgra8": "BGRA", "mono8": "L"}
JOINT_STATE = "sensor_msgs/msg/JointState"


class Entities:
    """Logs to the recording that `rerun.init` opened."""

    def __init__(self) -> None:
        self._placed: set[str] = set()
        self._loggers = {
            "tf2_msgs/msg/TFMessage": self._log_transforms,
            JOINT_STATE: self._log_joints,
            "sensor_msgs/msg/Image": self._log_image,
            "sensor_msgs/msg/CompressedImage": self._log_compressed,
            "sensor_msgs/msg/CameraInfo": self._log_camera,
            "sensor_msgs/msg/PointCloud2": self._log_points,
        }

    def log_message(self, topic: str, message: Any) -> None:
        """Log a message; ValueError if its type is not known here."""
        kind = msg.type_name(type(message))
        if kind not in self._loggers:
            raise ValueError(f"{topic} has the type {kind}; known are {', '.join(self._loggers)}")
        self._loggers[kind](topic, message)

    def log_bag(self, bag: Bag) -> None:
        """Log the transforms and joint states of a bag in columns, and the other messages.

        Topics of other types are left out.

        Raises:
            ValueError: The bag has only topics of other types.
        """
        types = {name: topic.type for name, topic in bag.topics.items()}
        if self._loggers.keys().isdisjoint(types.values()):
            found = ", ".join(sorted(set(types.values()))) or "no topics"
            raise ValueError(f"the bag has {found}; known are {', '.join(self._loggers)}")
        if not {"/tf", "/tf_static"}.isdisjoint(types):
            self.log_buffer(Buffer.from_bag(bag))
        for name in (name for name, kind in types.items() if kind == JOINT_STATE):
            send_joints(bag, name)
        sensors = [kind for kind in self._loggers if kind.startswith("sensor_msgs/")]
        sensors.remove(JOINT_STATE)
        if wanted := [name for name, kind in types.items() if kind in sensors]:
            for message in bag.messages(wanted):
                self.log_message(message.topic, message.decode())

    def log_buffer(self, buffer: Buffer) -> None:
        """Log all transforms of a buffer."""
        for link in buffer.links():
            child = link.child_frame
            if link.static:
                pose = np.array(buffer.lookup_transform(link.parent_frame, child))
                self._log_pose(link.parent_frame, child, pose, is_static=True)
                continue
            self._draw_axes(child)
            for parent, stamps, poses in buffer.samples(child):
                send_poses(parent, child, stamps, poses)

    def _log_transforms(self, topic: str, message: Any) -> None:
        for each in message.transforms:
            place, turn = each.transform.translation, each.transform.rotation
            set_time(each.header.stamp)
            parent, child = frame_name(each.header.frame_id), frame_name(each.child_frame_id)
            pose = [place.x, place.y, place.z, turn.x, turn.y, turn.z, turn.w]
            self._log_pose(parent, child, pose, is_static=topic.endswith("_static"))

    def _log_pose(self, parent: str, child: str, pose: Any, *, is_static: bool) -> None:
        self._draw_axes(child)
        made = rr.Transform3D(
            translation=pose[:3], quaternion=pose[3:], parent_frame=parent, child_frame=child
        )
        rr.log(f"tf/{child}", made, static=is_static)

    def _draw_axes(self, child: str) -> None:
        if self._place(f"tf/{child}", child):
            rr.log(f"tf/{child}", rr.TransformAxes3D(AXES, show_frame=True), static=True)

    def _place(self, entity: str, frame: str) -> bool:
        """Put an entity into its frame; return False if it is there already."""
        is_new = entity not in self._placed
        if is_new:
            self._placed.add(entity)
            rr.log(entity, rr.CoordinateFrame(frame), static=True)
        return is_new

    def _log_joints(self, topic: str, message: Any) -> None:
        set_time(message.header.stamp)
        for name, position in zip(message.name, message.position, strict=False):
            rr.log(f"{topic}/{name}", rr.Scalars(position))

    def _log_image(self, topic: str, message: Any) -> None:
        if message.encoding not in COLOURS:
            return
        set_time(message.header.stamp)
        self._place(topic, image_frame(message))
        colours = COLOURS[message.encoding]
        rows = np.frombuffer(message.data, np.uint8).reshape(message.height, message.step)
        pixels = rows[:, : message.width * len(colours)]
        shape = (message.height, message.width, len(colours))
        rr.log(topic, rr.Image(pixels.reshape(shape), colours))

    def _log_compressed(self, topic: str, message: Any) -> None:
        set_time(message.header.stamp)
        self._place(topic, image_frame(message))
        # image_transport writes "rgb8; jpeg compressed bgr8", for example.
        kind = "image/png" if "png" in message.format else "image/jpeg"
        rr.log(topic, rr.EncodedImage(contents=bytes(message.data), media_type=kind))

    def _log_camera(self, topic: str, message: Any) -> None:
        set_time(message.header.stamp)
        pinhole = rr.Pinhole(
            image_from_camera=np.reshape(message.k, (3, 3)),
            resolution=[message.width, message.height],
            parent_frame=frame_name(message.header.frame_id),
            child_frame=image_frame(message),
            image_plane_distance=IMAGES,
        )
        rr.log(topic, pinhole)

    def _log_points(self, topic: str, message: Any) -> None:
        offsets = {field.name: field.offset for field in message.fields if field.datatype == 7}
        if not {"x", "y", "z"} <= offsets.keys():
            return
        set_time(message.header.stamp)
        self._place(topic, frame_name(message.header.frame_id))
        layout = {
            "names": ["x", "y", "z"],
            "formats": ["<f4"] * 3,
            "offsets": [offsets[axis] for axis in "xyz"],
            "itemsize": message.point_step,
        }
        count = len(message.data) // message.point_step
        points = np.frombuffer(message.data, np.dtype(layout), count)
        rr.log(topic, rr.Points3D(np.column_stack([points[axis] for axis in "xyz"])))


def frame_name(written: str) -> str:
    """Return the name without the slash of ROS 1, which tf2 removes from transforms."""
    return written.removeprefix("/")


def image_frame(message: Any) -> str:
    """Return the frame of the pixels of a camera."""
    return f"{frame_name(message.header.frame_id)} image"


def set_time(stamp: Any) -> None:
    """Set the time of what is logged next."""
    nanoseconds = stamp.sec * 1_000_000_000 + stamp.nanosec
    rr.set_time("stamp", timestamp=np.datetime64(nanoseconds, "ns"))


def send_poses(parent: str, child: str, stamps_ns: np.ndarray, poses: np.ndarray) -> None:
    """Log the poses of a frame in its parent as columns."""
    columns = rr.Transform3D.columns(
        translation=poses[:, :3],
        quaternion=poses[:, 3:],
        parent_frame=[parent] * len(stamps_ns),
        child_frame=[child] * len(stamps_ns),
    )
    rr.send_columns(f"tf/{child}", [times(stamps_ns)], columns)


def send_joints(bag: Bag, topic: str) -> None:
    """Log the positions of all joints of a topic, a column at a time."""
    table = bag.columns(topic, "name", "position")
    values: dict[str, list[tuple[int, float]]] = {}
    for stamp, names, positions in zip(
        table.stamps_ns.tolist(), table["name"], table["position"], strict=True
    ):
        for name, position in zip(names, positions.tolist(), strict=False):
            values.setdefault(name, []).append((stamp, position))
    for name, rows in values.items():
        stamps, positions = zip(*rows, strict=True)
        columns = rr.Scalars.columns(scalars=positions)
        rr.send_columns(f"{topic}/{name}", [times(np.array(stamps))], columns)


def times(stamps_ns: np.ndarray) -> rr.TimeColumn:
    """Return stamps as a column of the timeline."""
    return rr.TimeColumn("stamp", timestamp=stamps_ns.astype("datetime64[ns]"))
