"""Transforms point clouds in place: any layout of a point, any byte order, organised or not."""

from __future__ import annotations

from array import array
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from sensor_msgs.msg import PointCloud2, PointField
from tf2_geometry_msgs import from_msg_msg, to_msg_msg
from tf2_geometry_msgs.motion import Motion
from tf2_geometry_msgs.vectors import copy_of

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from geometry_msgs.msg import Transform, TransformStamped

__all__ = ["do_transform_cloud", "from_msg_msg", "to_msg_msg", "transform_points"]

_FLOATS = {PointField.FLOAT32: "f4", PointField.FLOAT64: "f8"}
_POINT = ("x", "y", "z")
_NORMAL = ("normal_x", "normal_y", "normal_z")

#: Points that are computed together: few enough to stay in the processor's cache.
_BLOCK = 8192


def do_transform_cloud(
    cloud: PointCloud2, transform: TransformStamped | Transform | Any
) -> PointCloud2:
    """Return a cloud in the frame of a transform; the arguments stay unchanged.

    The fields x, y, z are transformed and normal_x, normal_y, normal_z are rotated, in double
    precision. All other bytes are copied.

    Args:
        cloud: A cloud whose coordinates are float32 or float64 fields, at any offset.
        transform: A ``TransformStamped``, or a ``Transform``, which leaves the frame id as it is.

    Returns:
        A new cloud with the cloud's stamp, and the frame of the transform if that is stamped.

    Raises:
        AssertionError: The cloud has no x, y and z.
        ValueError: The coordinates are of another type, or the sizes contradict each other.
    """
    # The first field with a name is used.
    fields = {field.name: field for field in reversed(cloud.fields)}
    if not all(name in fields for name in _POINT):
        raise AssertionError("Point cloud needs the fields x, y, and z for the transformation")
    data = _copy_of(cloud.data)
    matrix = _matrix(transform)
    for rows in _rows(cloud, data, [fields[name] for name in _POINT]):
        _apply(matrix, rows, rows)
    if all(name in fields for name in _NORMAL):
        for rows in _rows(cloud, data, [fields[name] for name in _NORMAL]):
            _apply(matrix[:, :3], rows, rows)
    frame = transform.header.frame_id if hasattr(transform, "header") else cloud.header.frame_id
    return PointCloud2(
        header=copy_of(cloud.header.stamp, frame),
        height=cloud.height,
        width=cloud.width,
        fields=[
            PointField(name=f.name, offset=f.offset, datatype=f.datatype, count=f.count)
            for f in cloud.fields
        ],
        is_bigendian=cloud.is_bigendian,
        point_step=cloud.point_step,
        row_step=cloud.row_step,
        data=data,
        is_dense=cloud.is_dense,
    )


def transform_points(
    point_cloud: ArrayLike, transform: TransformStamped | Transform | Any
) -> NDArray[np.float64]:
    """Points in the frame of a transform.

    Args:
        point_cloud: Shape ``(N, 3)``, in metres.
        transform: ``Transform`` or ``TransformStamped``.

    Returns:
        A new array of shape ``(N, 3)``.

    Raises:
        ValueError: The points have another shape.
    """
    points = np.asarray(point_cloud)
    if points.ndim != 2 or points.shape[1] != 3:
        raise ValueError(f"points have the shape (N, 3), got {points.shape}")
    moved = np.empty(points.shape)
    _apply(_matrix(transform), list(points.T), list(moved.T))
    return moved


def _matrix(transform: Any) -> NDArray[np.float64]:
    motion = Motion(transform)
    return np.column_stack((np.reshape(motion.rows, (3, 3)), motion.translation))


def _apply(
    matrix: NDArray[np.float64], source: Sequence[NDArray[Any]], target: Sequence[NDArray[Any]]
) -> None:
    """Multiply three columns of points by a (3, 4) matrix, or of vectors by a (3, 3) matrix."""
    count = len(source[0])
    block = np.ones((matrix.shape[1], min(count, _BLOCK)))
    # Sensors mark points that they did not measure by NaN and infinity.
    with np.errstate(invalid="ignore", over="ignore"):
        for start in range(0, count, _BLOCK):
            part = slice(start, min(start + _BLOCK, count))
            values = block[:, : part.stop - start]
            # A row of ones, for the translation, stays.
            for row, column in zip(values, source, strict=False):
                row[:] = column[part]
            for column, moved in zip(target, matrix @ values, strict=True):
                column[part] = moved


def _rows(
    cloud: PointCloud2, data: array[int], fields: Sequence[PointField]
) -> Iterator[list[NDArray[Any]]]:
    """Yield, for each run of evenly spaced points, a view into the data for each field."""
    width = cloud.width * cloud.point_step
    row_step = cloud.row_step or width  # many writers do not set it
    # Rows without gaps between them are one run.
    rows, count = (
        (1, cloud.width * cloud.height)
        if cloud.height <= 1 or row_step == width
        else (cloud.height, cloud.width)
    )
    if count == 0:
        return
    needed = (rows - 1) * row_step + count * cloud.point_step
    if row_step < width or len(data) < needed:
        raise ValueError(
            f"a cloud of {cloud.width} x {cloud.height} points with point_step {cloud.point_step} "
            f"and row_step {cloud.row_step} needs {needed} bytes of data in rows of at least "
            f"{width}, has {len(data)}"
        )
    dtypes = [_dtype(cloud, field) for field in fields]
    for row in range(rows):
        yield [
            np.ndarray(count, dtype, data, row * row_step + field.offset, cloud.point_step)
            for dtype, field in zip(dtypes, fields, strict=True)
        ]


def _dtype(cloud: PointCloud2, field: PointField) -> np.dtype[Any]:
    if field.datatype not in _FLOATS:
        raise ValueError(
            f"field {field.name!r} has datatype {field.datatype}; "
            "only FLOAT32 (7) and FLOAT64 (8) can be transformed"
        )
    dtype = np.dtype((">" if cloud.is_bigendian else "<") + _FLOATS[field.datatype])
    if field.offset + dtype.itemsize > cloud.point_step:
        raise ValueError(
            f"field {field.name!r} ends at byte {field.offset + dtype.itemsize} "
            f"of a point of {cloud.point_step} bytes"
        )
    return dtype


def _copy_of(data: Any) -> array[int]:
    copied = array("B")
    copied.frombytes(bytes(data) if isinstance(data, list) else data)
    return copied
