"""Stand-ins for the objects of ROS 2's C library."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, NamedTuple

if TYPE_CHECKING:
    from typing_extensions import Self

    from rclpy._node.state import NodeState


class EndpointImpl(NamedTuple):
    """An endpoint of the middleware and its node, for the constructors of endpoints.

    Attributes:
        wire: The middleware's side of a publisher, a subscription, a service or a client.
        core: The state of the node.
    """

    wire: Any
    core: NodeState


@contextmanager
def closed_on_error(impl: EndpointImpl) -> Iterator[EndpointImpl]:
    """Yield an announced endpoint, and close it if the block raises, as ROS 2 does."""
    try:
        yield impl
    except BaseException:
        impl.wire.close()
        raise


class Handle:
    """Gives what its owner has.

    A ``with`` block around it, as programs for ROS 2 write one, leaves the owner as it is.
    """

    def __init__(self, owner: Any) -> None:
        self._owner = owner

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *exception: object) -> None:
        """Nothing to release."""

    def __getattr__(self, name: str) -> Any:
        return getattr(self._owner, name)
