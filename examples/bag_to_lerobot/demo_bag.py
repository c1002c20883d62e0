"""Writes the bag of an arm with two joints: commands, joint states, transforms and a camera."""

from __future__ import annotations

import math
import random
import sys
from typing import TYPE_CHECKING, Any

import numpy as np

from turtlewire.bag import BagWriter
from turtlewire.msg import get_message

if TYPE_CHECKING:
    from collections.abc import Iterator

SECOND = 1_000_000_000
START = 1_700_000_000 * SECOND
JOINTS = ("shoulder", "elbow")
LENGTHS = (0.3, 0.2)  # of the two links, in metres
HEIGHT, WIDTH = 120, 160  # of the images, in pixels
SCALE = 100.0  # pixels for a metre

Image = get_message("sensor_msgs/msg/Image")
CameraInfo = get_message("sensor_msgs/msg/CameraInfo")
JointState = get_message("sensor_msgs/msg/JointState")
Command = get_message("std_msgs/msg/Float64MultiArray")
TFMessage = get_message("tf2_msgs/msg/TFMessage")
TransformStamped = get_message("geometry_msgs/msg/TransformStamped")


def hand(angles: np.ndarray) -> np.ndarray:
    """Return the position of the hand in the frame ``base_link``, in metres."""
    turns = np.cumsum(angles)
    return np.array([np.dot(LENGTHS, np.cos(turns)), np.dot(LENGTHS, np.sin(turns))])


def angles_over_time(seconds: float, seed: int) -> Iterator[tuple[int, np.ndarray, np.ndarray]]:
    """Yield milliseconds, commanded and actual angles; the joints follow the commands."""
    dice = random.Random(seed)  # noqa: S311 - a repeatable motion
    angles, command = np.zeros(2), np.zeros(2)
    for tick in range(round(seconds * 1000)):
        if tick % 1000 == 0:
            command = np.array([dice.uniform(-1.0, 1.0), dice.uniform(0.0, 2.0)])
        angles = angles + (command - angles) * 0.005
        yield tick, command, angles


def picture(angles: np.ndarray) -> np.ndarray:
    """Draw the base, the elbow and the hand (red) from above."""
    pixels = np.full((HEIGHT, WIDTH, 3), 200, np.uint8)
    rows, columns = np.mgrid[:HEIGHT, :WIDTH]
    elbow = LENGTHS[0] * np.array([math.cos(angles[0]), math.sin(angles[0])])
    for (x, y), colour in (((0.0, 0.0), 60), (elbow, 120), (hand(angles), (220, 40, 40))):
        column, row = WIDTH / 2 + SCALE * x, HEIGHT / 2 - SCALE * y
        pixels[(rows - row) ** 2 + (columns - column) ** 2 < 36] = colour
    return pixels


def transforms(angles: np.ndarray) -> list[Any]:
    """Return the transforms of the arm, without stamps."""
    made = []
    frames = ("base_link", "upper_arm", "forearm", "hand")
    offsets, turns = (0.0, *LENGTHS), (*angles, 0.0)
    for parent, child, offset, turn in zip(frames, frames[1:], offsets, turns, strict=False):
        transform = TransformStamped(child_frame_id=child)
        transform.header.frame_id = parent
        transform.transform.translation.x = offset
        transform.transform.rotation.z = math.sin(turn / 2)
        transform.transform.rotation.w = math.cos(turn / 2)
        made.append(transform)
    return made


def stamped(message: Any, now: int, frame: str = "") -> Any:
    """Set the header of a message, and return it."""
    message.header.stamp.sec, message.header.stamp.nanosec = divmod(now, SECOND)
    message.header.frame_id = frame or message.header.frame_id
    return message


def camera_pose() -> Any:
    """Return the transform of the camera: 1 m above the arm, x to the right, y down."""
    above = TransformStamped(child_frame_id="camera")
    above.transform.translation.z = 1.0
    above.transform.rotation.x, above.transform.rotation.w = 1.0, 0.0
    return above


def camera_images(now: int, angles: np.ndarray) -> tuple[Any, Any]:
    """Return the image of the camera and its calibration."""
    image = Image(height=HEIGHT, width=WIDTH, encoding="rgb8", step=3 * WIDTH)
    image.data = picture(angles).tobytes()
    info = CameraInfo(height=HEIGHT, width=WIDTH, distortion_model="plumb_bob", d=[0.0] * 5)
    info.k = [SCALE, 0.0, WIDTH / 2, 0.0, SCALE, HEIGHT / 2, 0.0, 0.0, 1.0]
    return stamped(image, now, "camera"), stamped(info, now, "camera")


def write_demo_bag(path: str, seconds: float = 5.0, seed: int = 1) -> None:
    """Write a bag with 100 states, 30 images and 20 commands a second."""
    with BagWriter(path, compression="zstd") as writer:
        fixed = stamped(camera_pose(), START, "base_link")
        writer.write("/tf_static", TFMessage(transforms=[fixed]), START)
        for tick, command, angles in angles_over_time(seconds, seed):
            now = START + tick * 1_000_000
            if tick % 50 == 7:
                writer.write("/commands", Command(data=command.tolist()), now)
            if tick % 10 == 0:
                state = JointState(name=list(JOINTS), position=angles.tolist())
                writer.write("/joint_states", stamped(state, now), now)
                moved = [stamped(each, now) for each in transforms(angles)]
                writer.write("/tf", TFMessage(transforms=moved), now)
            if tick * 30 % 1000 < 30:
                image, info = camera_images(now, angles)
                received = now + 2_000_000  # the image was on its way
                writer.write("/camera/image_raw", image, received)
                writer.write("/camera/camera_info", info, received)


if __name__ == "__main__":
    for number, name in enumerate(sys.argv[1:]):
        try:
            write_demo_bag(name, seed=number)
        except FileExistsError:
            sys.exit(f"{name} exists already")
        print(f"wrote {name}")
