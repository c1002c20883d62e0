"""The state of a node that its endpoints, parameters and services share."""

from __future__ import annotations

import weakref
from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING

from rclpy._node.rosout import RosoutPublisher
from rclpy._rclpy_pybind11 import InvalidHandle
from rclpy.logging import get_logger
from turtlewire.wire import names

if TYPE_CHECKING:
    from rclpy.context import Context
    from rclpy.impl.arguments import Arguments
    from rclpy.impl.rcutils_logger import RcutilsLogger
    from turtlewire.wire import base
    from turtlewire.wire.qos import QoS


class NodeState:
    """Names, context, logger, command line and the middleware's side of a node.

    The node leaves the graph with :meth:`close`, or when neither the node nor an endpoint of it is
    referred to any more: a publisher works as long as the program keeps it, as in ROS 2.

    Attributes:
        context: Its context.
        name: Base name, after remapping.
        namespace: Namespace, after remapping.
        full_name: Namespace and name, for example ``/robot1/camera``.
        arguments: Its command line.
        logger: Its logger, named like the node with dots for slashes.
        before_leaving: What to call before the node leaves the graph. None of it may refer to the
            core, which would live as long.
    """

    def __init__(
        self,
        context: Context,
        name: str,
        namespace: str,
        arguments: Arguments,
        *,
        rosout_qos: QoS | None,
    ) -> None:
        self.context = context
        self.name = name
        self.namespace = namespace
        self.full_name = names.fully_qualified_node_name(name, namespace)
        self.arguments = arguments
        self.logger: RcutilsLogger = get_logger(self.full_name[1:].replace("/", "."))
        self._wire = context.wire.create_node(name, namespace, arguments.enclave)
        rosout = (
            None
            if rosout_qos is None
            else RosoutPublisher(self._wire, self.logger.name, rosout_qos)
        )
        self.before_leaving: dict[Callable[[], None], None] = {}
        # Refers to the wire node instead of this object, which the finalizer must not keep alive.
        leave = partial(_leave, self._wire, rosout, self.before_leaving)
        self._end = weakref.finalize(self, _leave_later, context.wire, leave)
        self._end.atexit = False  # the node ends with its context
        self._leave = leave

    @property
    def wire(self) -> base.Node:
        """The middleware's side of it; raises ``InvalidHandle`` after :meth:`close`."""
        return self.checked()._wire

    def checked(self) -> NodeState:
        """Return itself; raise ``InvalidHandle`` after :meth:`close`."""
        if not self._end.alive:
            raise InvalidHandle("cannot use Destroyable because destruction was requested")
        return self

    def close(self) -> None:
        """Leave the graph, with all endpoints. Idempotent."""
        # None after an earlier call.
        if self._end.detach() is not None:
            self._leave()


def _leave(
    wire: base.Node, rosout: RosoutPublisher | None, before: dict[Callable[[], None], None]
) -> None:
    for call in list(before):
        call()
    if rosout is not None:
        rosout.close()
    wire.close()


def _leave_later(context: base.Context, leave: partial[None]) -> None:
    """Leave on another thread: the garbage collector runs anywhere, with any lock held."""
    context.call_soon(leave)
