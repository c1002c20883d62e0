"""The buffer of a node, with lookups that wait, also in callbacks, and lookups to ``await``."""

from __future__ import annotations

import functools
from typing import TYPE_CHECKING, Any

from rclpy.clock import Clock, JumpThreshold
from rclpy.duration import Duration
from tf2_py import BufferCore
from tf2_py.messages import to_moment, to_nanoseconds

from .buffer_interface import NO_TIMEOUT, BufferInterface
from .transform_futures import Leg, PendingLookup, TransformFutures

if TYPE_CHECKING:
    from geometry_msgs.msg import TransformStamped
    from rclpy.clock import BaseClock, TimeJump
    from rclpy.experimental import AsyncNode
    from rclpy.node import Node
    from rclpy.task import Future

#: The jumps of a clock after which the stored samples belong to another time.
JUMP_BACK = JumpThreshold(min_forward=None, min_backward=Duration(seconds=-1), on_clock_change=True)


class Buffer(BufferCore, BufferInterface):
    """Stores transforms and answers lookups. Safe for use from many threads.

    A :class:`~tf2_ros.TransformListener` fills it from its own thread, so a lookup with a
    timeout works anywhere, callbacks included: it blocks until the data arrives, and no executor
    has to spin.

    When the clock jumps back, as at the end of a bag that is played in a loop, the buffer drops all
    samples; static transforms stay. The clock is that of ``node`` or, without a node, that of the
    listener's node. A simulated clock advances while that node is spun.

    Args:
        cache_time: How long samples are kept; the default is 10 s.
        node: The node that offers the service ``tf2_frames`` (``tf2_msgs/srv/FrameGraph``), and
            whose clock counts.
        max_frames: How many frames it accepts; transforms of further ones are rejected, with a
            warning at most once a minute. None: no limit. Not in ROS 2.
    """

    def __init__(
        self,
        cache_time: Duration | None = None,
        node: Node | AsyncNode | None = None,
        *,
        max_frames: int | None = None,
    ) -> None:
        BufferCore.__init__(self, cache_time, max_frames=max_frames)
        BufferInterface.__init__(self)
        self._futures = TransformFutures(self.engine)
        self.node = node
        self.clock: BaseClock = Clock() if node is None else node.get_clock()
        if node is not None:
            self._offer_frames(node)
            self.jump_handle = self.clock.create_jump_callback(
                JUMP_BACK, post_callback=self.time_jump_callback
            )

    def _offer_frames(self, node: Node | AsyncNode) -> None:
        from tf2_msgs.srv import FrameGraph

        def answer(_request: Any, response: Any) -> Any:
            response.frame_yaml = self.all_frames_as_yaml()
            return response

        self.srv = node.create_service(FrameGraph, "tf2_frames", answer)

    def time_jump_callback(self, time_jump: TimeJump) -> None:  # noqa: ARG002 -- its size is unused
        """Drop all samples; called after the clock has jumped back."""
        from rclpy.logging import get_logger

        get_logger("tf2_buffer").warning("Detected jump back in time. Clearing tf buffer.")
        self.clear()

    def lookup_transform(
        self, target_frame: str, source_frame: str, time: Any, timeout: Duration | Any = NO_TIMEOUT
    ) -> TransformStamped:
        """Return the transform that takes data from ``source_frame`` into ``target_frame``.

        It is the pose of the source frame, expressed in the target frame.

        Args:
            target_frame: The frame in which the answer is expressed.
            source_frame: The frame whose pose is asked for.
            time: ``rclpy.time.Time`` or a time message; ``Time()`` asks for the latest time that
                all links between the frames have reached.
            timeout: How long to wait for the data (``rclpy.duration.Duration``).

        Raises:
            LookupException: A frame does not exist.
            ConnectivityException: The frames are not in one tree.
            ExtrapolationException: The data does not reach the time.
            InvalidArgumentException: A frame id is empty or starts with a slash.
        """
        # The usual case needs no conversion of a timeout.
        if timeout is NO_TIMEOUT:
            return self._messages.lookup(target_frame, source_frame, time)
        return self._messages.lookup(target_frame, source_frame, time, timeout)

    def lookup_transform_full(
        self,
        target_frame: str,
        target_time: Any,
        source_frame: str,
        source_time: Any,
        fixed_frame: str,
        timeout: Duration | Any = NO_TIMEOUT,
    ) -> TransformStamped:
        """Return the transform from ``source_frame`` at one time into ``target_frame`` at another.

        Args:
            target_frame: The frame in which the answer is expressed.
            target_time: The time of the target frame.
            source_frame: The frame whose pose is asked for.
            source_time: The time of the source frame.
            fixed_frame: A frame that did not move between the two times.
            timeout: How long to wait for the data.

        Raises:
            TransformException: As :meth:`lookup_transform`.
        """
        return self._messages.lookup_full(
            target_frame, target_time, source_frame, source_time, fixed_frame, timeout
        )

    def can_transform(
        self,
        target_frame: str,
        source_frame: str,
        time: Any,
        timeout: Duration | Any = NO_TIMEOUT,
        return_debug_tuple: bool = False,
    ) -> int | tuple[int, str]:
        """Return 1 if :meth:`lookup_transform` would succeed within ``timeout``, else 0.

        ``return_debug_tuple`` adds the reason of a failure: ``(0, text)``.
        """
        reason = self.engine._can_transform_reason(
            target_frame,
            source_frame,
            to_moment(time),
            timeout_ns=to_nanoseconds(timeout, "duration"),
        )
        return (int(not reason), reason) if return_debug_tuple else int(not reason)

    def can_transform_full(
        self,
        target_frame: str,
        target_time: Any,
        source_frame: str,
        source_time: Any,
        fixed_frame: str,
        timeout: Duration | Any = NO_TIMEOUT,
        return_debug_tuple: bool = False,
    ) -> int | tuple[int, str]:
        """Return 1 if :meth:`lookup_transform_full` would succeed within ``timeout``, else 0.

        ``return_debug_tuple`` adds the reason of a failure: ``(0, text)``.
        """
        reason = self.engine._can_transform_reason(
            target_frame,
            source_frame,
            to_moment(source_time),
            timeout_ns=to_nanoseconds(timeout, "duration"),
            fixed_frame=fixed_frame,
            target_stamp_ns=to_moment(target_time),
        )
        return (int(not reason), reason) if return_debug_tuple else int(not reason)

    async def lookup_transform_async(
        self, target_frame: str, source_frame: str, time: Any, *, timeout: Duration | Any = None
    ) -> TransformStamped:
        """:meth:`lookup_transform` for ``async def`` callbacks and asyncio.

        Args:
            target_frame: The frame in which the answer is expressed.
            source_frame: The frame whose pose is asked for.
            time: The time of the transform; ``Time()`` asks for the latest time.
            timeout: How long to wait; None waits without limit.

        Raises:
            TransformException: As :meth:`lookup_transform`, after the timeout, or when no
                later data can bring the answer.
        """
        return await _outcome(
            self.wait_for_transform_async(target_frame, source_frame, time, timeout=timeout)
        )

    async def lookup_transform_full_async(
        self,
        target_frame: str,
        target_time: Any,
        source_frame: str,
        source_time: Any,
        fixed_frame: str,
        *,
        timeout: Duration | Any = None,
    ) -> TransformStamped:
        """:meth:`lookup_transform_full`, waiting like :meth:`lookup_transform_async`."""
        asked = (target_frame, target_time, source_frame, source_time, fixed_frame)
        return await _outcome(self.wait_for_transform_full_async(*asked, timeout=timeout))

    def wait_for_transform_async(
        self, target_frame: str, source_frame: str, time: Any, *, timeout: Duration | Any = None
    ) -> Future:
        """Return a future for the transform. Cancel it if you no longer need the transform.

        Its done-callbacks run on the thread that receives the data, and should be short. Arguments
        and errors are the same as for :meth:`lookup_transform_async`.
        """
        leg = Leg(target_frame, source_frame, to_nanoseconds(time))
        answer = functools.partial(self.lookup_transform_core, target_frame, source_frame, time)
        return self._futures.add(PendingLookup(self.engine, (leg,), answer), _limit(timeout))

    def wait_for_transform_full_async(
        self,
        target_frame: str,
        target_time: Any,
        source_frame: str,
        source_time: Any,
        fixed_frame: str,
        *,
        timeout: Duration | Any = None,
    ) -> Future:
        """:meth:`wait_for_transform_async` for :meth:`lookup_transform_full`."""
        legs = (
            Leg(target_frame, fixed_frame, to_nanoseconds(target_time)),
            Leg(fixed_frame, source_frame, to_nanoseconds(source_time)),
        )
        answer = functools.partial(
            self.lookup_transform_full_core,
            target_frame,
            target_time,
            source_frame,
            source_time,
            fixed_frame,
        )
        return self._futures.add(PendingLookup(self.engine, legs, answer), _limit(timeout))


async def _outcome(future: Future) -> TransformStamped:
    try:
        transform: TransformStamped = await future
    finally:
        future.cancel()  # has an effect only if the awaiting task was cancelled
    return transform


def _limit(timeout: Duration | Any) -> int | None:
    return None if timeout is None else to_nanoseconds(timeout, "duration")
