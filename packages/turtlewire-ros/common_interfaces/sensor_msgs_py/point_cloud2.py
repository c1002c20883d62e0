"""Converts point clouds to NumPy arrays and back."""

from __future__ import annotations

import sys
from array import array
from collections import namedtuple
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from sensor_msgs.msg import PointCloud2, PointField

from .numpy_compat import structured_to_unstructured, unstructured_to_structured

if TYPE_CHECKING:
    from std_msgs.msg import Header

DUMMY_FIELD_PREFIX = "unnamed_field"
"""The name of a nameless field is this prefix and the field's number."""

_DATATYPES: dict[int, np.dtype[Any]] = {
    PointField.INT8: np.dtype(np.int8),
    PointField.UINT8: np.dtype(np.uint8),
    PointField.INT16: np.dtype(np.int16),
    PointField.UINT16: np.dtype(np.uint16),
    PointField.INT32: np.dtype(np.int32),
    PointField.UINT32: np.dtype(np.uint32),
    PointField.FLOAT32: np.dtype(np.float32),
    PointField.FLOAT64: np.dtype(np.float64),
}


def read_points(
    cloud: PointCloud2,
    field_names: Sequence[str] | None = None,
    skip_nans: bool = False,
    uvs: Iterable[int] | None = None,
    reshape_organized_cloud: bool = False,
) -> np.ndarray[Any, np.dtype[np.void]]:
    """Return the points of a cloud as a structured array.

    Args:
        cloud: The cloud.
        field_names: The fields to read, in this order; None for all.
        skip_nans: Leave out points with a NaN, unless the cloud says that it is dense.
        uvs: Indices of the points to read, counted after NaNs were skipped; None for all.
        reshape_organized_cloud: Give the points of a cloud with rows the shape (width, height).

    Returns:
        The points, shape (N,). They share the memory of the message, except with ``skip_nans``,
        ``uvs``, foreign byte order or padded rows.

    Raises:
        AssertionError: A name is not a field of the cloud.
    """
    dtype = dtype_from_fields(cloud.fields, point_step=cloud.point_step)
    points = _points(cloud, dtype)
    if field_names is not None:
        if not all(name in (dtype.names or ()) for name in field_names):
            raise AssertionError("Requests field is not in the fields of the point cloud.")
        points = points[list(field_names)]
    if cloud.is_bigendian != (sys.byteorder == "big"):
        points = points.byteswap()
    if skip_nans and not cloud.is_dense:
        points = points[
            ~np.any([np.isnan(points[name]) for name in points.dtype.names or ()], axis=0)
        ]
    if uvs is not None:
        points = points[uvs if isinstance(uvs, np.ndarray) else np.fromiter(uvs, int)]
    if reshape_organized_cloud and cloud.height > 1:
        # As in ROS 2, although the message has the points row by row.
        points = points.reshape(cloud.width, cloud.height)
    return points


def _points(cloud: PointCloud2, dtype: np.dtype[np.void]) -> np.ndarray[Any, np.dtype[np.void]]:
    """Return all points in one row, without the padding between rows."""
    points: np.ndarray[Any, np.dtype[np.void]]
    if cloud.height > 1 and cloud.row_step > cloud.width * cloud.point_step:
        strides = (cloud.row_step, cloud.point_step)
        points = np.ndarray(
            (cloud.height, cloud.width), dtype, cloud.data, strides=strides
        ).reshape(-1)
    else:  # many writers do not set row_step
        points = np.ndarray((cloud.height * cloud.width,), dtype, cloud.data)
    return points


def read_points_numpy(
    cloud: PointCloud2,
    field_names: Sequence[str] | None = None,
    skip_nans: bool = False,
    uvs: Iterable[int] | None = None,
    reshape_organized_cloud: bool = False,
) -> np.ndarray[Any, np.dtype[Any]]:
    """Return the points of a cloud with fields of one type, as an array of shape (N, fields).

    See `read_points` for the arguments.

    Raises:
        AssertionError: The fields are of several types, or a name is not a field of the cloud.
    """
    wanted = [field for field in cloud.fields if field_names is None or field.name in field_names]
    if len({field.datatype for field in wanted}) > 1:
        raise AssertionError(
            "All fields need to have the same datatype. Use `read_points()` otherwise."
        )
    plain: np.ndarray[Any, np.dtype[Any]] = structured_to_unstructured(
        read_points(cloud, field_names, skip_nans, uvs, reshape_organized_cloud)
    )
    return plain


def read_points_list(
    cloud: PointCloud2,
    field_names: Sequence[str] | None = None,
    skip_nans: bool = False,
    uvs: Iterable[int] | None = None,
) -> list[Any]:
    """Return the points of a cloud as a list of named tuples; slow for large clouds.

    See `read_points` for the arguments.
    """
    names = [field.name for field in cloud.fields] if field_names is None else list(field_names)
    point = namedtuple("Point", names)  # type: ignore[misc]  # noqa: PYI024
    return [
        point._make(values) for values in read_points(cloud, field_names, skip_nans, uvs).tolist()
    ]


def dtype_from_fields(
    fields: Iterable[PointField], point_step: int | None = None
) -> np.dtype[np.void]:
    """Return the structured dtype of a point.

    Args:
        fields: Its fields; one with a count above one becomes ``name_0``, ``name_1`` and so on.
        point_step: Bytes from point to point; None ends a point after its last field.

    Raises:
        AssertionError: A count is zero, or two fields have one name.
    """
    names: list[str] = []
    formats: list[np.dtype[Any]] = []
    offsets: list[int] = []
    for index, field in enumerate(fields):
        datatype = _DATATYPES[field.datatype]
        if field.count == 0:
            raise AssertionError("Can't process fields with count = 0.")
        for part in range(field.count):
            name = field.name or f"{DUMMY_FIELD_PREFIX}_{index}"
            names.append(name if field.count == 1 else f"{name}_{part}")
            formats.append(datatype)
            offsets.append(field.offset + part * datatype.itemsize)
    if len(set(names)) < len(names):
        raise AssertionError("Duplicate field names are not allowed!")
    layout: Any = {"names": names, "formats": formats, "offsets": offsets}
    if point_step is not None:
        layout["itemsize"] = point_step
    dtype: np.dtype[np.void] = np.dtype(layout)
    return dtype


def create_cloud(
    header: Header, fields: Sequence[PointField], points: Any, point_step: int | None = None
) -> PointCloud2:
    """Make a cloud.

    Args:
        header: Its header.
        fields: The fields of a point.
        points: A structured array of their dtype, a plain array with a last axis of that length, or
            an iterable of tuples.
        point_step: Bytes from point to point; None ends a point after its last field.

    Raises:
        AssertionError: The array does not fit the fields, or has more than two axes of points.
    """
    structured = np.ascontiguousarray(_structured(fields, points, point_step))
    if structured.ndim > 2:
        raise AssertionError(
            "Too many dimensions for organized cloud! "
            "Points can only be organized in max. two dimensional space"
        )
    # As in ROS 2, the first axis is the width.
    width, height = structured.shape[0], structured.shape[1] if structured.ndim == 2 else 1
    data = array("B")
    data.frombytes(structured.tobytes())
    return PointCloud2(
        header=header,
        height=height,
        width=width,
        fields=list(fields),
        is_bigendian=sys.byteorder == "big",
        point_step=structured.dtype.itemsize,
        row_step=structured.dtype.itemsize * width,
        data=data,
        # As in ROS 2, the points are not searched for NaNs.
        is_dense=False,
    )


def create_cloud_xyz32(header: Header, points: Any, point_step: int | None = None) -> PointCloud2:
    """Make a cloud of float32 x, y, z; see `create_cloud` for the arguments."""
    fields = [
        PointField(name=name, offset=4 * index, datatype=PointField.FLOAT32, count=1)
        for index, name in enumerate("xyz")
    ]
    return create_cloud(header, fields, points, point_step)


def _structured(fields: Sequence[PointField], points: Any, point_step: int | None) -> Any:
    dtype = dtype_from_fields(fields, point_step)
    if not isinstance(points, np.ndarray):
        return np.array([tuple(point) for point in points], dtype=dtype)
    if points.dtype.names is None:
        if len({field.datatype for field in fields}) > 1:
            raise AssertionError(
                "All fields need to have the same datatype. "
                "Pass a structured NumPy array with multiple dtypes otherwise."
            )
        return unstructured_to_structured(points, dtype=dtype)
    if points.dtype != dtype:
        raise AssertionError(
            "PointFields and structured NumPy array dtype do not match for all fields! "
            "Check their field order, names and types."
        )
    return points
