"""Says ``Hello World`` on ``chatter``, reliably or with best effort."""

from __future__ import annotations

from demo_nodes_py.spin import profile, run_cycles
from demo_nodes_py.topics.talker import Talker


class TalkerQos(Talker):
    """Publishes a counted greeting every second.

    Args:
        reliable: Whether lost messages are sent again.
    """

    def __init__(self, reliable: bool) -> None:
        super().__init__("talker_qos", profile(reliable=reliable))
        self.get_logger().info("Reliable talker" if reliable else "Best effort talker")


def main(args: list[str] | None = None) -> None:
    """Talk until Ctrl-C or for ``-n`` cycles."""
    run_cycles(TalkerQos, "talker", args)
