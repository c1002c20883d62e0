"""Help beside the texts that ROS 2 defines."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeVar

if TYPE_CHECKING:
    from .node import Node
    from .publisher import Publisher

__all__ = ["described", "require", "warn_if_unheard", "with_hint"]

_Error = TypeVar("_Error", bound=BaseException)
#: How long a publisher may be without a subscription: discovery takes less [s].
_PATIENCE_S = 2.0


def with_hint(error: _Error, hint: str) -> _Error:
    """Attach ``hint`` (nothing if empty) and return the same error.

    Tracebacks show it as a note on Python 3.11 and later.
    """
    error.hint = hint  # type: ignore[attr-defined]
    if hint and hasattr(error, "add_note"):
        error.add_note(hint)
    return error


def described(value: Any) -> str:
    """What a value is, in words: ``None``, ``the class String``, ``an object of type float``."""
    if value is None:
        return "None"
    return (
        f"the class {value.__qualname__}"
        if isinstance(value, type)
        else f"an object of type {type(value).__qualname__}"
    )


def require(value: object, kind: type) -> None:
    """Raise the AssertionError that ROS 2 raises for a value of another type.

    Unlike an ``assert`` statement it works under ``python -O``, too.
    """
    if not isinstance(value, kind):
        raise AssertionError(  # noqa: TRY004 - ROS 2's error
            f"expected an object of type {kind.__name__}, got {described(value)}"
        )


def warn_if_unheard(node: Node, publisher: Publisher) -> None:
    """Warn once if, two seconds from now, nothing subscribes to what a node publishes.

    The warning names the other domains in which this computer has nodes.
    """
    from .clock import Clock
    from .clock_type import ClockType

    def look() -> None:
        node.destroy_timer(timer)
        if not publisher.get_subscription_count():
            node.get_logger().warning(_unheard(publisher.topic_name, node.context.get_domain_id()))

    real_time = Clock(clock_type=ClockType.STEADY_TIME)  # a simulated clock may stand still
    timer = node.create_timer(_PATIENCE_S, look, clock=real_time)


def _unheard(topic: str, domain: int) -> str:
    from turtlewire.cli.network import domains_of, udp_ports

    text = f"No node subscribes to {topic} on domain {domain}."
    others = sorted(domains_of(udp_ports()) - {domain})
    if not others:
        return f"{text} Is the node running that it is for?"
    return (
        f"{text} This computer has nodes on domain {', '.join(map(str, others))}: to reach "
        f"them, end this program and type: export ROS_DOMAIN_ID={others[0]}"
    )
