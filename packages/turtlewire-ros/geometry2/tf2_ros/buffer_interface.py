# ruff: noqa: ARG002 -- the interface's own methods use none of their arguments
"""The interface of all buffers: lookups, and transforming and converting stamped data."""

from __future__ import annotations

from collections.abc import Callable
from copy import deepcopy
from typing import TYPE_CHECKING, Any

from rclpy.duration import Duration

if TYPE_CHECKING:
    from geometry_msgs.msg import TransformStamped

#: The import that registers a type.
_REGISTERED_BY = {
    "tf2_geometry_msgs": {
        "geometry_msgs/PointStamped",
        "geometry_msgs/PolygonInstanceStamped",
        "geometry_msgs/PolygonStamped",
        "geometry_msgs/PoseArray",
        "geometry_msgs/PoseStamped",
        "geometry_msgs/PoseWithCovarianceStamped",
        "geometry_msgs/QuaternionStamped",
        "geometry_msgs/TransformStamped",
        "geometry_msgs/TwistStamped",
        "geometry_msgs/TwistWithCovarianceStamped",
        "geometry_msgs/Vector3Stamped",
        "geometry_msgs/VelocityStamped",
        "geometry_msgs/WrenchStamped",
        "nav_msgs/Odometry",
        "nav_msgs/Path",
    },
    "tf2_sensor_msgs": {"sensor_msgs/PointCloud2"},
}

#: Do not wait.
NO_TIMEOUT = Duration()


class TypeException(Exception):
    """No function is registered that transforms or converts the type.

    Attributes:
        errstr: The text.
    """

    def __init__(self, errstr: str) -> None:
        super().__init__(errstr)
        self.errstr = errstr


class NotImplementedException(Exception):
    """This kind of buffer does not support a method of the interface.

    Attributes:
        errstr: The text.
    """

    def __init__(self) -> None:
        self.errstr = "CanTransform or LookupTransform not implemented"
        super().__init__(self.errstr)


def _unknown_type(key: Any) -> TypeException:
    error = TypeException(f"Type {key} is not loaded or supported")
    advice = _advice(key)
    # Python 3.10 has no notes.
    if advice and hasattr(error, "add_note"):
        error.add_note(advice)
    return error


def _advice(key: Any) -> str:
    name = getattr(key, "__name__", "")
    full_name = f"{str(getattr(key, '__module__', '')).partition('.')[0]}/{name}"
    for module, types in _REGISTERED_BY.items():
        if full_name in types:
            return f"`import {module}` registers this type."
        if f"{full_name}Stamped" in types:
            return f"A {name} does not name its frame: transform a {name}Stamped."
    return ""


class BufferInterface:
    """Base of the buffers.

    Attributes:
        registration: The functions that transform types; one table for the whole process.
    """

    def __init__(self) -> None:
        self.registration = TransformRegistration()

    def transform(
        self,
        object_stamped: Any,
        target_frame: str,
        timeout: Any = NO_TIMEOUT,
        new_type: type | None = None,
    ) -> Any:
        """Express an object in another frame, at the time of its stamp.

        Args:
            object_stamped: An object with a ``header`` whose type is registered; ``import
                tf2_geometry_msgs`` registers many.
            target_frame: The frame to express it in.
            timeout: How long to wait until the transform is known (``rclpy.duration.Duration``).
            new_type: Convert the result to this type.

        Raises:
            TypeException: Its type is not registered.
            TransformException: The transform is not known, see :meth:`lookup_transform`.
        """
        do_transform = self.registration.get(type(object_stamped))
        header = object_stamped.header
        transformed = do_transform(
            object_stamped,
            self.lookup_transform(target_frame, header.frame_id, header.stamp, timeout),
        )
        return transformed if new_type is None else convert(transformed, new_type)

    def transform_full(
        self,
        object_stamped: Any,
        target_frame: str,
        target_time: Any,
        fixed_frame: str,
        timeout: Any = NO_TIMEOUT,
        new_type: type | None = None,
    ) -> Any:
        """Express an object in another frame at another time.

        Args:
            object_stamped: As for :meth:`transform`.
            target_frame: The frame to express it in.
            target_time: The time of that frame (``rclpy.time.Time``).
            fixed_frame: A frame that does not move between the two times.
            timeout: How long to wait until the transform is known.
            new_type: Convert the result to this type.

        Raises:
            TypeException: Its type is not registered.
            TransformException: The transform is not known.
        """
        do_transform = self.registration.get(type(object_stamped))
        header = object_stamped.header
        transform = self.lookup_transform_full(
            target_frame, target_time, header.frame_id, header.stamp, fixed_frame, timeout
        )
        transformed = do_transform(object_stamped, transform)
        return transformed if new_type is None else convert(transformed, new_type)

    def lookup_transform(
        self, target_frame: str, source_frame: str, time: Any, timeout: Any = NO_TIMEOUT
    ) -> TransformStamped:
        """Return the transform from ``source_frame`` to ``target_frame`` at ``time``."""
        raise NotImplementedException

    def lookup_transform_full(
        self,
        target_frame: str,
        target_time: Any,
        source_frame: str,
        source_time: Any,
        fixed_frame: str,
        timeout: Any = NO_TIMEOUT,
    ) -> TransformStamped:
        """Return the transform from one frame and time to another, by way of ``fixed_frame``."""
        raise NotImplementedException

    def can_transform(
        self, target_frame: str, source_frame: str, time: Any, timeout: Any = NO_TIMEOUT
    ) -> Any:
        """Return True if :meth:`lookup_transform` would succeed."""
        raise NotImplementedException

    def can_transform_full(
        self,
        target_frame: str,
        target_time: Any,
        source_frame: str,
        source_time: Any,
        fixed_frame: str,
        timeout: Any = NO_TIMEOUT,
    ) -> Any:
        """Return True if :meth:`lookup_transform_full` would succeed."""
        raise NotImplementedException


def Stamped(obj: Any, stamp: Any, frame_id: str) -> Any:  # noqa: N802 -- ROS 2's name
    """Give an object a header, in place, and return it."""
    from std_msgs.msg import Header

    obj.header = Header(frame_id=frame_id, stamp=stamp)
    return obj


class TransformRegistration:
    """The functions that transform types; all instances share one table."""

    _transforms: dict[type, Callable[[Any, TransformStamped], Any]] = {}  # noqa: RUF012 -- shared

    def print_me(self) -> None:
        """Print the table."""
        print(self._transforms)  # noqa: T201 -- what it is for

    def add(self, key: type, callback: Callable[[Any, TransformStamped], Any]) -> None:
        """Register ``callback(object, transform)`` for objects of type ``key``."""
        self._transforms[key] = callback

    def get(self, key: type) -> Callable[[Any, TransformStamped], Any]:
        """Return the function for a type.

        Raises:
            TypeException: No function is registered for the type.
        """
        try:
            return self._transforms[key]
        except KeyError:
            raise _unknown_type(key) from None


class ConvertRegistration:
    """The functions that convert types to messages, from messages, and directly.

    All instances share one table.
    """

    _to_msg: dict[type, Callable[[Any], Any]] = {}  # noqa: RUF012 -- shared
    _from_msg: dict[type, Callable[[Any], Any]] = {}  # noqa: RUF012
    _convert: dict[tuple[type, type], Callable[[Any], Any]] = {}  # noqa: RUF012

    def add_from_msg(self, key: type, callback: Callable[[Any], Any]) -> None:
        """Register ``callback(message)``, which makes a ``key``."""
        self._from_msg[key] = callback

    def add_to_msg(self, key: type, callback: Callable[[Any], Any]) -> None:
        """Register ``callback(object)``, which makes a message of a ``key``."""
        self._to_msg[key] = callback

    def add_convert(self, key: tuple[type, type], callback: Callable[[Any], Any]) -> None:
        """Register ``callback(object)``, which converts a ``key[0]`` to a ``key[1]``."""
        self._convert[key] = callback

    def get_from_msg(self, key: type) -> Callable[[Any], Any]:
        """Return the function of :meth:`add_from_msg`; raises :class:`TypeException` if unknown."""
        return self._get(self._from_msg, key)

    def get_to_msg(self, key: type) -> Callable[[Any], Any]:
        """Return the function of :meth:`add_to_msg`; raises :class:`TypeException` if unknown."""
        return self._get(self._to_msg, key)

    def get_convert(self, key: tuple[type, type]) -> Callable[[Any], Any]:
        """Return the function of :meth:`add_convert`; raises :class:`TypeException` if unknown."""
        return self._get(self._convert, key)

    @staticmethod
    def _get(table: dict[Any, Callable[[Any], Any]], key: Any) -> Callable[[Any], Any]:
        try:
            return table[key]
        except KeyError:
            raise _unknown_type(key) from None


def convert(a: Any, b_type: type) -> Any:
    """Convert ``a`` to ``b_type``.

    A direct conversion is preferred; an object of that type is copied; the last way is through a
    message.

    Raises:
        TypeException: No conversion is registered, or the registered one gives another type.
    """
    registration = ConvertRegistration()
    try:
        direct = registration.get_convert((type(a), b_type))
    except TypeException:
        if type(a) is b_type:
            return deepcopy(a)
        converted = registration.get_from_msg(b_type)(registration.get_to_msg(type(a))(a))
        # The conversion from a message accepts any message: only the result shows if it fitted.
        if not isinstance(converted, b_type):
            raise TypeException(f"No conversion from {type(a)} to {b_type} is registered") from None
        return converted
    return direct(a)
