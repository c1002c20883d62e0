"""Transforming a PointCloud2 of 300,000 points, against the same in one NumPy expression."""

from __future__ import annotations

import time
from array import array
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

from benchmarks.figures import Figure, Row

TITLE = "tf2_sensor_msgs.do_transform_cloud, 300,000 points (computed in double precision)"
POINTS = 300_000
REPEATS = 20
RIVAL = "x.astype(float64) @ R.T + t"


def rows() -> Iterator[Row]:
    from tf2_sensor_msgs import do_transform_cloud

    for what, names, step, bigendian in (
        ("x, y, z, intensity, 16 bytes a point", "xyzi", 16, False),
        ("the same, 32 bytes a point", "xyzi", 32, False),
        ("the same, big-endian", "xyzi", 16, True),
    ):
        cloud, transform = make_cloud(names, step, bigendian=bigendian), make_transform()
        ours = figure(lambda cloud=cloud, transform=transform: do_transform_cloud(cloud, transform))
        rival = figure(lambda cloud=cloud: in_one_expression(cloud))
        yield Row(what, ours, {RIVAL: rival}, "<= 10 ms")


def figure(work: Callable[[], Any]) -> Figure:
    runs = []
    for _ in range(REPEATS):
        start = time.perf_counter_ns()
        work()
        runs.append(time.perf_counter_ns() - start)
    return Figure.of(runs)


def make_cloud(names: str, step: int, *, bigendian: bool) -> Any:
    from sensor_msgs.msg import PointCloud2, PointField

    order = ">" if bigendian else "<"
    points = np.zeros(
        POINTS, {"names": list(names), "formats": [f"{order}f4"] * len(names), "itemsize": step}
    )
    for name in names:
        points[name] = np.random.default_rng(0).uniform(-50, 50, POINTS)
    fields = [
        PointField(name=name, offset=4 * i, datatype=PointField.FLOAT32, count=1)
        for i, name in enumerate(names)
    ]
    cloud = PointCloud2(
        height=1,
        width=POINTS,
        fields=fields,
        is_bigendian=bigendian,
        point_step=step,
        row_step=POINTS * step,
    )
    cloud.data = array("B", points.tobytes())
    return cloud


def make_transform() -> Any:
    from geometry_msgs.msg import TransformStamped

    transform = TransformStamped()
    transform.transform.translation.x = 1.0
    transform.transform.rotation.z, transform.transform.rotation.w = 0.6, 0.8
    return transform


def in_one_expression(cloud: Any) -> array[int]:
    data = cloud.data[:]
    floats = np.frombuffer(data, ">f4" if cloud.is_bigendian else "<f4").reshape(
        POINTS, cloud.point_step // 4
    )
    rotation = np.array([(0.28, -0.96, 0.0), (0.96, 0.28, 0.0), (0.0, 0.0, 1.0)])
    floats[:, :3] = floats[:, :3].astype(np.float64) @ rotation.T + (1.0, 0.0, 0.0)
    return data
