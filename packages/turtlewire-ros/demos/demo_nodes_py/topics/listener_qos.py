"""Logs the messages on ``chatter``, reliably or with best effort."""

from __future__ import annotations

from demo_nodes_py.spin import profile, run_cycles
from demo_nodes_py.topics.listener import Listener


class ListenerQos(Listener):
    """Logs each greeting.

    Args:
        reliable: Whether lost messages are asked for again; a best-effort talker does not match
            then.
    """

    def __init__(self, reliable: bool) -> None:
        super().__init__("listener_qos", profile(reliable=reliable))
        self.get_logger().info("Reliable listener" if reliable else "Best effort listener")


def main(args: list[str] | None = None) -> None:
    """Listen until Ctrl-C or for ``-n`` cycles."""
    run_cycles(ListenerQos, "listener", args)
