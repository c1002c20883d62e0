"""Publishes a wavy surface of 10,000 points on ``test_cloud``."""

from __future__ import annotations

import contextlib

import numpy as np

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from sensor_msgs.msg import PointCloud2, PointField
from sensor_msgs_py import point_cloud2
from std_msgs.msg import Header


class PointCloudPublisher(Node):
    """Publishes the surface 30 times a second, a little further each time."""

    rate = 30
    moving = True
    width = 100
    height = 100
    header = Header(frame_id="map")
    fields = (
        PointField(name="x", offset=0, datatype=PointField.FLOAT32, count=1),
        PointField(name="y", offset=4, datatype=PointField.FLOAT32, count=1),
        PointField(name="z", offset=8, datatype=PointField.FLOAT32, count=1),
        PointField(name="intensity", offset=12, datatype=PointField.FLOAT32, count=1),
    )

    def __init__(self) -> None:
        super().__init__("pc_publisher")
        self.publisher_ = self.create_publisher(PointCloud2, "test_cloud", 10)
        self.timer = self.create_timer(1 / self.rate, self.timer_callback)
        self.counter = 0

    def timer_callback(self) -> None:
        """Publish the surface of this moment."""
        self.header.stamp = self.get_clock().now().to_msg()
        x, y = np.meshgrid(np.linspace(-2, 2, self.width), np.linspace(-2, 2, self.height))
        z = 0.5 * np.sin(2 * x - self.counter / 10.0) * np.sin(2 * y)
        # The height is also the intensity.
        points = np.stack([x, y, z, z], axis=-1).reshape(-1, 4).astype(np.float32)
        self.publisher_.publish(point_cloud2.create_cloud(self.header, [*self.fields], points))
        if self.moving:
            self.counter += 1


def main(args: list[str] | None = None) -> None:
    """Publish until Ctrl-C."""
    with contextlib.suppress(KeyboardInterrupt, ExternalShutdownException), rclpy.init(args=args):
        rclpy.spin(PointCloudPublisher())
