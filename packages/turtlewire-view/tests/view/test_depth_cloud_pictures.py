"""Depth clouds in a real browser: the points are as large as their pixels."""

# ruff: noqa: F811 - fixtures are imported
from __future__ import annotations

import numpy as np
import pytest

from .looking_down import BLUE, RED, scene, shown_page, stamped  # noqa: F401 - fixtures

LEFT, RIGHT = (-1, 0, 0), (1, 0, 0)


@pytest.fixture
def eye(scene):
    """A camera 4 m above the ground that looks down at it, with an image of two pixels."""
    scene.source.buffer.set_static_transform("map", "eye", (0, 0, 4), (1, 0, 0, 0))
    k = [2.0, 0, 0.5, 0, 2.0, 0, 0, 0, 1.0]
    info = stamped("sensor_msgs/msg/CameraInfo", "eye", width=2, height=1, k=k)
    scene.topic += "/depth"
    scene.source.offer(scene.topic.replace("/depth", "/camera_info"), info)
    colors = np.array([[[255, 0, 0], [0, 0, 255]]], np.uint8)
    color = image("rgb8", colors)
    scene.source.offer(scene.topic.replace("/depth", "/color"), color)
    return scene


def image(encoding, pixels):
    message = stamped("sensor_msgs/msg/Image", "eye", encoding=encoding, height=1, width=2)
    message.step, message.data = pixels.strides[0], pixels.tobytes()
    return message


def two_depths():
    return image("16UC1", np.array([[4000, 4000]], np.uint16))


@pytest.mark.parametrize("style", ["flat squares", "boxes"])
def test_points_are_as_wide_as_their_pixels(eye, style):
    eye.show("depth_cloud", two_depths(), style=style, color="flat", flat_color="#ff0000")
    # At 4 m with a focal length of 2 pixels, a pixel is 2 m wide.
    eye.expect_red(LEFT, RIGHT, (-1.9, 0.9, 0), (1.9, -0.9, 0))
    eye.expect_ground((0, 1.2, 0), (2.2, 0, 0))
    eye.set_option("auto_size_factor", 0.5)
    eye.expect_red(LEFT, (1.4, 0.4, 0))
    eye.expect_ground((0, 0, 0), (1.7, 0, 0))
    eye.set_option("size_metres", 0.2)
    eye.set_option("auto_size", False)
    eye.expect_red(LEFT)
    eye.expect_ground((1.4, 0, 0))


def test_points_have_the_colours_of_another_image(eye):
    eye.show("depth_cloud", two_depths(), color_topic=eye.topic.replace("/depth", "/color"))
    eye.expect((LEFT, RED), (RIGHT, BLUE))


def test_a_wrong_topic_of_colours_is_named(eye):
    eye.show("depth_cloud", two_depths(), color_topic="/nowhere")
    eye.expect_status("No image received on [/nowhere]")
    eye.set_option("color_topic", eye.topic.replace("/depth", "/color"))
    eye.expect((LEFT, RED), (RIGHT, BLUE))
    eye.set_option("color_topic", "")
    eye.set_option("color", "flat")
    eye.expect((LEFT, (255, 255, 255)))


def test_a_depth_image_of_colours_is_refused_with_one_line(eye):
    eye.show("depth_cloud", image("rgb8", np.zeros((1, 2, 3), np.uint8)))
    eye.expect_status("the encoding 'rgb8' is not supported for depths")
    eye.send(two_depths())
    eye.set_option("color", "flat")
    eye.expect((LEFT, (255, 255, 255)))
