"""The buffer of a node: lookups that can wait, in callbacks too, and awaitable ones."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rclpy.clock import Clock, JumpThreshold
from rclpy.duration import Duration
from tf2_py import BufferCore
from tf2_py.times import to_nanoseconds

from .buffer_interface import NO_TIMEOUT, BufferInterface
from .transform_futures import TransformFutures

if TYPE_CHECKING:
    from geometry_msgs.msg import TransformStamped
    from rclpy.clock import TimeJump
    from rclpy.node import Node
    from rclpy.task import Future

__all__ = ["Buffer"]


class Buffer(BufferCore, BufferInterface):
    """Stores transforms and answers questions about them. Safe for use from many threads.

    A :class:`~tf2_ros.TransformListener` fills it from a thread of its own, so a timeout works wherever a lookup is called: the call
    sleeps until the data is there, polls nothing, and needs nobody to spin.

    Args:
        cache_time: How long samples are kept; 10 s unless given.
        node: Offers the service ``tf2_frames`` (``tf2_msgs/srv/FrameGraph``) on this node and follows its clock: when that jumps back, what
            was stored is of another time, and is forgotten. Static transforms stay.
    """

    def __init__(self, cache_time: Duration | None = None, node: Node | None = None) -> None:
        BufferCore.__init__(self, cache_time)
        BufferInterface.__init__(self)
        self._futures = TransformFutures(self.engine)
        self.node = node
        self.clock = Clock() if node is None else node.get_clock()
        if node is not None:
            self._offer_frames(node)
            threshold = JumpThreshold(min_forward=None, min_backward=Duration(seconds=-1), on_clock_change=True)
            self.jump_handle = self.clock.create_jump_callback(threshold, post_callback=self.time_jump_callback)

    def _offer_frames(self, node: Node) -> None:
        from tf2_msgs.srv import FrameGraph

        def answer(_request: Any, response: Any) -> Any:
            response.frame_yaml = self.all_frames_as_yaml()
            return response

        self.srv = node.create_service(FrameGraph, "tf2_frames", answer)

    def time_jump_callback(self, time_jump: TimeJump) -> None:  # noqa: ARG002 -- any jump that passed the threshold counts
        """Forget all samples after the clock has jumped back."""
        from rclpy.logging import get_logger

        get_logger("tf2_buffer").warning("Detected jump back in time. Clearing tf buffer.")
        self.clear()

    def lookup_transform(self, target_frame: str, source_frame: str, time: Any, timeout: Duration | Any = NO_TIMEOUT) -> TransformStamped:
        """The transform that takes data of ``source_frame`` into ``target_frame``: the pose of the source, seen from the target.

        Args:
            target_frame: The frame in which the answer is expressed.
            source_frame: The frame whose pose is asked for.
            time: ``rclpy.time.Time`` or a time message; ``Time()`` asks for the latest time known to all links in between.
            timeout: How long to wait for the data (``rclpy.duration.Duration``).

        Raises:
            LookupException: A frame does not exist.
            ConnectivityException: The frames are not in one tree.
            ExtrapolationException: The data does not reach the time.
            InvalidArgumentException: A frame id is empty or starts with a slash.
        """
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
        """The transform from ``source_frame`` as it was at ``source_time`` into ``target_frame`` as it was at ``target_time``.

        Args:
            target_frame: The frame in which the answer is expressed.
            target_time: When.
            source_frame: The frame whose pose is asked for.
            source_time: When.
            fixed_frame: A frame that did not move between the two times.
            timeout: How long to wait for the data.

        Raises:
            TransformException: As :meth:`lookup_transform`.
        """
        return self._messages.lookup_full(target_frame, target_time, source_frame, source_time, fixed_frame, timeout)

    def can_transform(
        self,
        target_frame: str,
        source_frame: str,
        time: Any,
        timeout: Duration | Any = NO_TIMEOUT,
        return_debug_tuple: bool = False,
    ) -> int | tuple[int, str]:
        """1 if :meth:`lookup_transform` would succeed, within ``timeout``, else 0; with ``return_debug_tuple`` the reason besides."""
        reason = self.engine.can_transform_reason(target_frame, source_frame, to_nanoseconds(time), to_nanoseconds(timeout, "duration"))
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
        """1 if :meth:`lookup_transform_full` would succeed, within ``timeout``, else 0; with ``return_debug_tuple`` the reason besides."""
        times = to_nanoseconds(target_time), to_nanoseconds(source_time)
        timeout_ns = to_nanoseconds(timeout, "duration")
        reason = self.engine.can_transform_full_reason(target_frame, times[0], source_frame, times[1], fixed_frame, timeout_ns)
        return (int(not reason), reason) if return_debug_tuple else int(not reason)

    async def lookup_transform_async(self, target_frame: str, source_frame: str, time: Any) -> TransformStamped:
        """:meth:`lookup_transform` for ``async def`` callbacks and asyncio: waits until the transform is known."""
        return await self.wait_for_transform_async(target_frame, source_frame, time)

    async def lookup_transform_full_async(
        self, target_frame: str, target_time: Any, source_frame: str, source_time: Any, fixed_frame: str
    ) -> TransformStamped:
        """:meth:`lookup_transform_full` for ``async def`` callbacks and asyncio: waits until the transform is known."""
        return await self.wait_for_transform_full_async(target_frame, target_time, source_frame, source_time, fixed_frame)

    def wait_for_transform_async(self, target_frame: str, source_frame: str, time: Any) -> Future:
        """A future whose result will be the transform, once it is known. Cancel it when it is not wanted any more.

        Done-callbacks run on the thread that brings the data, and should be short.
        """
        stamp = to_nanoseconds(time)
        return self._futures.add(
            lambda: self.engine.can_transform(target_frame, source_frame, stamp),
            lambda: self.lookup_transform_core(target_frame, source_frame, time),
        )

    def wait_for_transform_full_async(
        self, target_frame: str, target_time: Any, source_frame: str, source_time: Any, fixed_frame: str
    ) -> Future:
        """As :meth:`wait_for_transform_async`, for :meth:`lookup_transform_full`."""
        times = to_nanoseconds(target_time), to_nanoseconds(source_time)
        return self._futures.add(
            lambda: self.engine.can_transform_full(target_frame, times[0], source_frame, times[1], fixed_frame),
            lambda: self.lookup_transform_full_core(target_frame, target_time, source_frame, source_time, fixed_frame),
        )
