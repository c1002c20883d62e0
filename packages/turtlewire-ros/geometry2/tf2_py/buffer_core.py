"""tf2's buffer with the methods and signatures of ROS 2's ``tf2_py``, on turtlewire's engine."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeAlias

import turtlewire
from tf2_py.messages import message_lookup
from tf2_py.times import to_nanoseconds
from turtlewire.tf.inspection import links

if TYPE_CHECKING:
    from geometry_msgs.msg import TransformStamped
    from rclpy.duration import Duration
    from rclpy.time import Time

    Triple: TypeAlias = tuple[float, float, float]

__all__ = ["BufferCore"]

_DEFAULT_CACHE_NS = 10_000_000_000


class BufferCore:
    """A tree of frames over time. Safe for use from many threads.

    Args:
        cache_time: How long samples are kept (``rclpy.duration.Duration`` or a duration message);
            by default 10 s.
        max_frames: How many frames it takes; transforms of further ones are refused. None: no
            limit. Not in ROS 2.

    Attributes:
        engine: The ``turtlewire.Buffer`` underneath, with integer nanoseconds, bytes and batches.
    """

    engine: turtlewire.Buffer

    def __init__(
        self, cache_time: Duration | Any | None = None, *, max_frames: int | None = None
    ) -> None:
        self.engine = turtlewire.Buffer(
            _DEFAULT_CACHE_NS if cache_time is None else to_nanoseconds(cache_time, "duration"),
            max_frames,
        )
        self._messages = message_lookup(self.engine)

    # -- data in

    def set_transform(self, transform: TransformStamped | Any, authority: str) -> None:
        """Add a transform at the time of its stamp. A refusal is logged with its reason."""
        self._set(transform, authority, static=False)

    def set_transform_static(self, transform: TransformStamped | Any, authority: str) -> None:
        """Add a transform that holds at all times."""
        self._set(transform, authority, static=True)

    def _set(self, transform: TransformStamped | Any, authority: str, *, static: bool) -> None:
        header, pose = transform.header, transform.transform
        t, q = pose.translation, pose.rotation
        stamp = to_nanoseconds(header.stamp)
        refusal = self.engine.set_transform(
            header.frame_id,
            transform.child_frame_id,
            stamp,
            (t.x, t.y, t.z),
            (q.x, q.y, q.z, q.w),
            static,
            authority,
        )
        if refusal:
            _log_refusal(refusal)

    def clear(self) -> None:
        """Drop all samples; frame names and static transforms stay."""
        self.engine.clear()

    # -- questions

    def lookup_transform_core(
        self, target_frame: str, source_frame: str, time: Time | Any
    ) -> TransformStamped:
        """The transform that takes data from ``source_frame`` into ``target_frame``; does not wait.

        Raises:
            LookupException: A frame does not exist.
            ConnectivityException: The frames are not in one tree.
            ExtrapolationException: The data does not reach the time.
            InvalidArgumentException: A frame id is empty or starts with a slash.
        """
        return self._messages.lookup(target_frame, source_frame, time)

    def lookup_transform_full_core(
        self,
        target_frame: str,
        target_time: Time | Any,
        source_frame: str,
        source_time: Time | Any,
        fixed_frame: str,
    ) -> TransformStamped:
        """The transform between two frames at two times, by way of a frame that did not move."""
        return self._messages.lookup_full(
            target_frame, target_time, source_frame, source_time, fixed_frame
        )

    def can_transform_core(
        self, target_frame: str, source_frame: str, time: Time | Any
    ) -> tuple[int, str]:
        """1 and an empty string if a lookup would succeed, else 0 and the reason."""
        reason = self.engine.can_transform_reason(target_frame, source_frame, to_nanoseconds(time))
        return (int(not reason), reason)

    def can_transform_full_core(
        self,
        target_frame: str,
        target_time: Time | Any,
        source_frame: str,
        source_time: Time | Any,
        fixed_frame: str,
    ) -> tuple[int, str]:
        """:meth:`can_transform_core` for :meth:`lookup_transform_full_core`."""
        times = to_nanoseconds(target_time), to_nanoseconds(source_time)
        reason = self.engine.can_transform_full_reason(
            target_frame, times[0], source_frame, times[1], fixed_frame
        )
        return (int(not reason), reason)

    def get_latest_common_time(self, target_frame: str, source_frame: str, /) -> Time:
        """Return the newest time that every link between the frames has reached."""
        from rclpy.time import Time

        return Time(nanoseconds=self.engine.latest_common_time(target_frame, source_frame))

    # -- velocities

    def lookupVelocityCore(  # noqa: N802 -- ROS 2's name
        self,
        tracking_frame: str,
        observation_frame: str,
        time: Time | Any,
        averaging_interval: Duration | Any,
    ) -> tuple[Triple, Triple]:
        """Linear [m/s] and angular velocity [rad/s] of ``tracking_frame``.

        Velocity of its origin relative to ``observation_frame`` and in the axes of that frame, as
        mean over the interval around ``time``.
        """
        return self.lookupVelocityFullCore(
            tracking_frame,
            observation_frame,
            observation_frame,
            (0.0, 0.0, 0.0),
            tracking_frame,
            time,
            averaging_interval,
        )

    def lookupVelocityFullCore(  # noqa: N802 -- ROS 2's name
        self,
        tracking_frame: str,
        observation_frame: str,
        reference_frame: str,
        reference_point: Triple,
        reference_point_frame: str,
        time: Time | Any,
        averaging_interval: Duration | Any,
        /,
    ) -> tuple[Triple, Triple]:
        """The velocity at a ``reference_point`` of the body, in the axes of ``reference_frame``."""
        vx, vy, vz, wx, wy, wz = self.engine.lookup_velocity(
            tracking_frame,
            observation_frame,
            to_nanoseconds(time),
            interval_ns=to_nanoseconds(averaging_interval, "duration"),
            reference_frame=reference_frame,
            point=reference_point,
            point_frame=reference_point_frame,
        ).tolist()
        return (vx, vy, vz), (wx, wy, wz)

    # -- descriptions

    def _chain(
        self,
        target_frame: str,
        target_time: Time | Any,
        source_frame: str,
        source_time: Time | Any,
        fixed_frame: str,
    ) -> list[str]:
        """Return the frames from the source over the fixed frame to the target.

        Raises:
            TransformException: The frames are not connected at these times.
        """
        self.lookup_transform_full_core(
            target_frame, target_time, source_frame, source_time, fixed_frame
        )
        parents = {link.child_frame: link.parent_frame for link in links(self.engine)}
        return (
            _way(parents, source_frame, fixed_frame) + _way(parents, fixed_frame, target_frame)[1:]
        )

    def all_frames_as_yaml(self, *_ignored: Any) -> str:
        """Frames, parents, senders, rates and ages as YAML. Arguments are ignored, as in ROS 2."""
        return self.engine.all_frames_as_yaml()

    def all_frames_as_string(self, *_ignored: Any) -> str:
        """One line for each frame with its parent. Arguments are ignored, as in ROS 2."""
        return self.engine.all_frames_as_string()

    def _allFramesAsDot(self, time: Time | Any | None = None) -> str:  # noqa: N802 -- ROS 2's name
        """Return the tree as Graphviz text; ``time`` is the present, for ages."""
        return self.engine.all_frames_as_dot(0.0 if time is None else to_nanoseconds(time) / 1e9)

    def _repr_svg_(self) -> str:
        """Return the tree of frames as SVG, for notebooks."""
        return self.engine._repr_svg_()

    def _frameExists(self, frame_id: str, /) -> bool:  # noqa: N802 -- ROS 2's name
        """Return True if any transform has named the frame."""
        return self.engine.frame_exists(frame_id)

    def _getFrameStrings(self) -> list[str]:  # noqa: N802 -- ROS 2's name
        """Return the names of all frames, in order of arrival."""
        return self.engine.frame_strings()


def _way(parents: dict[str, str], start: str, end: str) -> list[str]:
    """Up from one frame to the nearest common ancestor and down to the other."""
    up, down = _line(parents, start), _line(parents, end)
    meeting = next(frame for frame in up if frame in down)
    return up[: up.index(meeting) + 1] + down[: down.index(meeting)][::-1]


def _line(parents: dict[str, str], frame: str) -> list[str]:
    line = [frame]
    while (parent := parents.get(line[-1])) and parent not in line:
        line.append(parent)
    return line


def _log_refusal(reason: str) -> None:
    from rclpy.logging import get_logger

    logger = get_logger("tf2")
    if reason.startswith("TF_OLD_DATA"):
        logger.warning(reason)
    else:
        logger.error(reason)
