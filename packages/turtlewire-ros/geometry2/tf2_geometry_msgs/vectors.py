"""Points, vectors, quaternions and polygons in another frame. Nothing changes its arguments."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeVar

from builtin_interfaces.msg import Time
from geometry_msgs.msg import (
    Point,
    Point32,
    PointStamped,
    Polygon,
    PolygonInstance,
    PolygonInstanceStamped,
    PolygonStamped,
    Quaternion,
    QuaternionStamped,
    Vector3,
    Vector3Stamped,
)
from std_msgs.msg import Header
from tf2_geometry_msgs.motion import Motion

if TYPE_CHECKING:
    from geometry_msgs.msg import TransformStamped

_P = TypeVar("_P", Point, PointStamped)
_V = TypeVar("_V", Vector3, Vector3Stamped)


def do_transform_point(point: _P, transform: TransformStamped | Any) -> _P:
    """Return a point in the frame of a transform.

    Args:
        point: ``PointStamped`` or ``Point``, in the transform's source frame (``child_frame_id``).
        transform: ``TransformStamped``; a ``Transform`` is enough for a ``Point``.

    Returns:
        A new message of the same type; a stamped one has stamp and frame of the transform.
    """
    if hasattr(point, "point"):
        x, y, z = Motion(transform).point(point.point)
        return PointStamped(header=header_of(transform), point=Point(x=x, y=y, z=z))  # type: ignore[return-value]
    x, y, z = Motion(transform).point(point)
    return Point(x=x, y=y, z=z)  # type: ignore[return-value]


def do_transform_vector3(vector3: _V, transform: TransformStamped | Any) -> _V:
    """Return a free vector in the frame of a transform: turned, not moved.

    Args:
        vector3: ``Vector3Stamped`` or ``Vector3``, in the transform's source frame.
        transform: ``TransformStamped``; a ``Transform`` is enough for a ``Vector3``.

    Returns:
        A new message of the same type; a stamped one has stamp and frame of the transform.
    """
    if hasattr(vector3, "vector"):
        x, y, z = Motion(transform).vector(vector3.vector)
        return Vector3Stamped(header=header_of(transform), vector=Vector3(x=x, y=y, z=z))  # type: ignore[return-value]
    x, y, z = Motion(transform).vector(vector3)
    return Vector3(x=x, y=y, z=z)  # type: ignore[return-value]


def do_transform_point32(point32: Point32, transform: TransformStamped | Any) -> Point32:
    """Return a point of single precision; computed in double precision."""
    x, y, z = Motion(transform).point(point32)
    return Point32(x=x, y=y, z=z)


def do_transform_quaternion(
    quaternion: Quaternion, transform: TransformStamped | Any
) -> Quaternion:
    """Return an orientation in the frame of a transform, of unit length and with w >= 0."""
    x, y, z, w = Motion(transform).orientation(quaternion)
    return Quaternion(x=x, y=y, z=z, w=w)


def do_transform_quaternion_stamped(
    quaternion: QuaternionStamped, transform: TransformStamped
) -> QuaternionStamped:
    """:func:`do_transform_quaternion` with stamp and frame of the transform."""
    return QuaternionStamped(
        header=header_of(transform),
        quaternion=do_transform_quaternion(quaternion.quaternion, transform),
    )


def do_transform_polygon(polygon: Polygon, transform: TransformStamped | Any) -> Polygon:
    """Return a polygon in the frame of a transform, corner by corner."""
    corner = Motion(transform).point
    return Polygon(points=[Point32(x=x, y=y, z=z) for x, y, z in map(corner, polygon.points)])


def do_transform_polygon_stamped(
    polygon: PolygonStamped, transform: TransformStamped
) -> PolygonStamped:
    """:func:`do_transform_polygon` with stamp and frame of the transform."""
    return PolygonStamped(
        header=header_of(transform), polygon=do_transform_polygon(polygon.polygon, transform)
    )


def do_transform_polygon_instance(
    polygon: PolygonInstance, transform: TransformStamped | Any
) -> PolygonInstance:
    """:func:`do_transform_polygon` of a polygon with an id, which stays."""
    return PolygonInstance(polygon=do_transform_polygon(polygon.polygon, transform), id=polygon.id)


def do_transform_polygon_instance_stamped(
    polygon: PolygonInstanceStamped, transform: TransformStamped
) -> PolygonInstanceStamped:
    """:func:`do_transform_polygon_instance` with stamp and frame of the transform."""
    return PolygonInstanceStamped(
        header=header_of(transform),
        polygon=do_transform_polygon_instance(polygon.polygon, transform),
    )


def header_of(transform: Any) -> Header:
    """Return a new header with frame and stamp of a ``TransformStamped``.

    The data is now in that frame, and of that time.
    """
    try:
        header = transform.header
    except AttributeError:
        raise TypeError(
            "stamped data needs a geometry_msgs.msg.TransformStamped, whose header says in which "
            "frame the result is; "
            f"got {type(transform).__name__}"
        ) from None
    return copy_of(header.stamp, header.frame_id)


def copy_of(stamp: Any, frame_id: str) -> Header:
    """Return a header with the values of a stamp."""
    return Header(stamp=Time(sec=stamp.sec, nanosec=stamp.nanosec), frame_id=frame_id)
