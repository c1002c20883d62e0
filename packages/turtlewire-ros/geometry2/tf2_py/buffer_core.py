"""tf2's buffer with the methods and signatures of ROS 2's ``tf2_py``, on turtlewire's engine."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeAlias

import turtlewire
from tf2_py.messages import message_lookup, to_moment, to_nanoseconds
from turtlewire.distro import LYRICAL, current_distro, since
from turtlewire.tf.links import links
from turtlewire.wording import Wording

if TYPE_CHECKING:
    from geometry_msgs.msg import TransformStamped
    from rclpy.duration import Duration
    from rclpy.time import Time

    Triple: TypeAlias = tuple[float, float, float]

_DEFAULT_CACHE_NS = 10_000_000_000
_HINT_IF_EMPTY = (
    "No transform has arrived yet. Is a broadcaster running, and does a TransformListener fill "
    "this buffer?"
)
_WORDING = Wording("pass rclpy.time.Time()", "buffer.engine.problems()")


class BufferCore:
    """A tree of frames over time. Safe for use from many threads.

    Args:
        cache_time: How long samples are kept (``rclpy.duration.Duration`` or a duration message);
            by default 10 s.
        max_frames: How many frames it accepts; transforms of further ones are rejected. None: no
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
        self.engine._follow_tf2(current_distro())
        self.engine._hint_if_empty = _HINT_IF_EMPTY
        self.engine._wording = _WORDING
        self._messages = message_lookup(self.engine)

    # -- data in

    def set_transform(self, transform: TransformStamped | Any, authority: str) -> None:
        """Add a transform at the time of its stamp. A rejected one is logged with the reason."""
        self._set(transform, authority, static=False)

    def set_transform_static(self, transform: TransformStamped | Any, authority: str) -> None:
        """Add a transform that holds at all times."""
        self._set(transform, authority, static=True)

    def _set(self, transform: TransformStamped | Any, authority: str, *, static: bool) -> None:
        header, pose = transform.header, transform.transform
        t, q = pose.translation, pose.rotation
        stamp = to_nanoseconds(header.stamp)
        refusal = self.engine._set_transform(
            header.frame_id,
            transform.child_frame_id,
            stamp,
            (t.x, t.y, t.z),
            (q.x, q.y, q.z, q.w),
            static,
            sender=authority,
        )
        if refusal:
            _log_refusal(refusal)

    def clear(self) -> None:
        """Drop all samples; frame names stay, and static transforms, except in Lyrical."""
        self.engine.clear()

    # -- questions

    def lookup_transform_core(
        self, target_frame: str, source_frame: str, time: Time | Any
    ) -> TransformStamped:
        """Return the transform from ``source_frame`` to ``target_frame``; does not wait.

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
        """Return the transform between two frames at two times, via a frame that did not move."""
        return self._messages.lookup_full(
            target_frame, target_time, source_frame, source_time, fixed_frame
        )

    def can_transform_core(
        self, target_frame: str, source_frame: str, time: Time | Any
    ) -> tuple[int, str]:
        """Return 1 and an empty string if a lookup would succeed, else 0 and the reason."""
        reason = self.engine._can_transform_reason(target_frame, source_frame, to_moment(time))
        return (_succeeds(reason), reason)

    def can_transform_full_core(
        self,
        target_frame: str,
        target_time: Time | Any,
        source_frame: str,
        source_time: Time | Any,
        fixed_frame: str,
    ) -> tuple[int, str]:
        """:meth:`can_transform_core` for :meth:`lookup_transform_full_core`."""
        reason = self.engine._can_transform_reason(
            target_frame,
            source_frame,
            to_moment(source_time),
            fixed_frame=fixed_frame,
            target_stamp_ns=to_moment(target_time),
        )
        return (_succeeds(reason), reason)

    def get_latest_common_time(self, target_frame: str, source_frame: str, /) -> Time:
        """Return the newest time that every link between the frames has reached."""
        from rclpy.time import Time

        return Time(nanoseconds=self.engine._latest_common_time(target_frame, source_frame))

    # -- velocities

    def lookupVelocityCore(  # noqa: N802 -- ROS 2's name
        self,
        tracking_frame: str,
        observation_frame: str,
        time: Time | Any,
        averaging_interval: Duration | Any,
    ) -> tuple[Triple, Triple]:
        """Return linear [m/s] and angular velocity [rad/s] of ``tracking_frame``.

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
        """Return the velocity of a ``reference_point``, in the axes of ``reference_frame``."""
        vx, vy, vz, wx, wy, wz = self.engine.lookup_velocity(
            observation_frame,
            tracking_frame,
            to_moment(time),
            interval_ns=to_nanoseconds(averaging_interval, "duration"),
            axes_frame=reference_frame,
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
        return way(parents, source_frame, fixed_frame) + way(parents, fixed_frame, target_frame)[1:]

    def all_frames_as_yaml(self, *_ignored: Any) -> str:
        """Frames, parents, senders, rates and ages as YAML. Arguments are ignored, as in ROS 2."""
        return self.engine.to_yaml()

    def all_frames_as_string(self, *_ignored: Any) -> str:
        """One line for each frame with its parent. Arguments are ignored, as in ROS 2."""
        return self.engine._frames_as_string()

    def _allFramesAsDot(self, time: Time | Any | None = None) -> str:  # noqa: N802 -- ROS 2's name
        """Return the tree as Graphviz text; ``time`` is the present, for ages."""
        return self.engine.to_dot(now_ns=None if time is None else to_nanoseconds(time))

    def _repr_svg_(self) -> str:
        """Return the tree of frames as SVG, for notebooks."""
        return self.engine._repr_svg_()

    def _frameExists(self, frame_id: str, /) -> bool:  # noqa: N802 -- ROS 2's name
        """Return True if any transform has named the frame."""
        return self.engine._knows(frame_id)

    def _getFrameStrings(self) -> list[str]:  # noqa: N802 -- ROS 2's name
        """Return the names of all frames, in order of arrival."""
        return self.engine.frames()


def way(parents: dict[str, str], start: str, end: str) -> list[str]:
    """Go up from one frame to the nearest common ancestor and down to the other."""
    up, down = _line(parents, start), _line(parents, end)
    meeting = next(frame for frame in up if frame in down)
    return up[: up.index(meeting) + 1] + down[: down.index(meeting)][::-1]


def _line(parents: dict[str, str], frame: str) -> list[str]:
    line = [frame]
    # The transforms may form a loop.
    while (parent := parents.get(line[-1])) and parent not in line:
        line.append(parent)
    return line


def _succeeds(reason: str) -> int:
    """Return the first item of can_transform_core's result, given the reason.

    Lyrical's tf2 reports success for a cleared static transform, but with half a reason.
    """
    return int(not reason or (since(LYRICAL) and reason.startswith(", when looking up")))


def _log_refusal(reason: str) -> None:
    from rclpy.logging import get_logger

    logger = get_logger("tf2")
    # tf2's severities.
    if reason.startswith("TF_OLD_DATA"):
        logger.warning(reason)
    else:
        logger.error(reason)
