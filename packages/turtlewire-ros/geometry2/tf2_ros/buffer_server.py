"""Answers lookups of other processes from a buffer of this one.

Those processes then need not receive all transforms themselves.
"""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Any

import rclpy
from rclpy.action import ActionServer, CancelResponse
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.duration import Duration
from rclpy.exceptions import InvalidParameterTypeException
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from tf2_msgs.action import LookupTransform
from tf2_msgs.msg import TF2Error
from turtlewire.errors import (
    ConnectivityException,
    ExtrapolationException,
    InvalidArgumentException,
    LookupException,
    TimeoutException,
    TransformException,
)

from .buffer import Buffer
from .transform_listener import TransformListener

if TYPE_CHECKING:
    from rclpy.action.server import ServerGoalHandle
    from rclpy.task import Future

_MOST_S = 1e9
# The base class comes last, because the first match counts.
_NUMBERS: dict[type[TransformException], int] = {
    LookupException: TF2Error.LOOKUP_ERROR,
    ConnectivityException: TF2Error.CONNECTIVITY_ERROR,
    ExtrapolationException: TF2Error.EXTRAPOLATION_ERROR,
    InvalidArgumentException: TF2Error.INVALID_ARGUMENT_ERROR,
    TimeoutException: TF2Error.TIMEOUT_ERROR,
    TransformException: TF2Error.TRANSFORM_ERROR,
}


def error_number(error: TransformException) -> int:
    """Return the number of an exception in ``tf2_msgs/msg/TF2Error``."""
    return next(number for kind, number in _NUMBERS.items() if isinstance(error, kind))


def exception_for(error: TF2Error) -> TransformException:
    """Return the exception of a ``tf2_msgs/msg/TF2Error``."""
    kinds = {number: kind for kind, number in _NUMBERS.items()}
    return kinds.get(error.error, TransformException)(error.error_string)


class BufferServer:
    """Offers lookups in a buffer as the action ``tf2_msgs/action/LookupTransform``.

    A waiting goal blocks no other goal, and can be cancelled. A goal without an answer in time is
    aborted with the error of the lookup, never with an empty transform.

    Args:
        buffer: Answers the lookups.
        node: The node that offers the action.
        ns: Name of the action.
    """

    def __init__(self, buffer: Buffer, node: Node, ns: str) -> None:
        self._buffer = buffer
        self._waiting: set[Future] = set()
        self._server = ActionServer(
            node,
            LookupTransform,
            ns,
            self._execute,
            cancel_callback=lambda _goal_handle: CancelResponse.ACCEPT,
            # Goals that wait must not hold up each other.
            callback_group=ReentrantCallbackGroup(),
        )

    def destroy(self) -> None:
        """Stop the action; waiting goals are aborted."""
        for future in list(self._waiting):
            future.cancel()
        self._server.destroy()

    async def _execute(self, goal_handle: ServerGoalHandle) -> Any:
        result = LookupTransform.Result()
        future = self._ask(goal_handle.request)
        self._waiting.add(future)
        # A client may cancel before the execution, also from another thread.
        goal_handle._goal.cancel_requested.add_done_callback(lambda _: future.cancel())
        try:
            result.transform = await future or result.transform  # None after a cancellation
        except TransformException as error:
            result.error = TF2Error(error=error_number(error), error_string=str(error))
        finally:
            self._waiting.remove(future)
        if future.cancelled():
            result.error = TF2Error(
                error=TF2Error.TIMEOUT_ERROR, error_string="The lookup was cancelled."
            )
            (goal_handle.canceled if goal_handle.is_cancel_requested else goal_handle.abort)()
        elif result.error.error == TF2Error.NO_ERROR:
            goal_handle.succeed()
        else:
            goal_handle.abort()
        return result

    def _ask(self, goal: Any) -> Future:
        if goal.advanced:
            return self._buffer.wait_for_transform_full_async(
                goal.target_frame,
                goal.target_time,
                goal.source_frame,
                goal.source_time,
                goal.fixed_frame,
                timeout=goal.timeout,
            )
        return self._buffer.wait_for_transform_async(
            goal.target_frame, goal.source_frame, goal.source_time, timeout=goal.timeout
        )


def main(args: list[str] | None = None) -> int:
    """Run `ros2 run tf2_ros buffer_server` until stopped; return the exit status.

    The parameter ``buffer_size`` says how many seconds of samples are kept; its default is 120.
    """
    rclpy.init(args=args)
    try:
        node = Node("tf_buffer")
        size_s = node.declare_parameter("buffer_size", 120.0).value
        if not 0.0 <= size_s <= _MOST_S:
            text = f"buffer_size is {size_s}; it can be 0 to {_MOST_S:.0f} seconds"
            print(text, file=sys.stderr)  # noqa: T201
            return 1
        buffer = Buffer(Duration(seconds=size_s), node)
        TransformListener(buffer, node)
        server = BufferServer(buffer, node, "tf2_buffer_server")
        rclpy.spin(node)
        server.destroy()
    except InvalidParameterTypeException as error:
        print("\n".join(filter(None, (str(error), error.hint))), file=sys.stderr)  # noqa: T201
        return 1
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        rclpy.try_shutdown()
    return 0
