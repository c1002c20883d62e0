"""``ros2 doctor hello``."""

from __future__ import annotations

import socket
from collections import Counter
from typing import TYPE_CHECKING, Any

from ros2cli.arguments import argument
from ros2cli.builtin import verb_of_module
from ros2cli.discovery import SPIN_ARGUMENTS
from ros2cli.values import positive_float, positive_int
from ros2doctor.verb import VerbExtension
from ros2multicast.api import DEFAULT_GROUP, DEFAULT_PORT, GROUP_ARGUMENTS, MulticastSocket

if TYPE_CHECKING:
    import argparse

__all__ = [
    "ARGUMENTS",
    "DEFAULT_GROUP",
    "DEFAULT_PORT",
    "HelloVerb",
    "main",
    "positive_float",
    "positive_int",
]

_WIDTH = 60


ARGUMENTS = (
    *SPIN_ARGUMENTS,
    *GROUP_ARGUMENTS,
    argument("-t", "--topic", default="/canyouhearme", help="Topic for the greetings"),
    argument(
        "-ep",
        "--emit-period",
        metavar="N",
        type=positive_float,
        default=0.1,
        help="Seconds between greetings",
    ),
    argument(
        "-pp",
        "--print-period",
        metavar="N",
        type=positive_float,
        default=1.0,
        help="Seconds between tables",
    ),
    argument("--ttl", type=positive_int, help="Maximum number of routers that a datagram may pass"),
    argument("-1", "--once", action="store_true", help="Exit after the first table"),
)


def main(args: argparse.Namespace) -> None:
    """Greet the other hosts and print a table of those that are heard, until Ctrl-C."""
    from rclpy.task import Future
    from ros2cli.node.direct import DirectNode
    from std_msgs.msg import String

    end = Future()
    with (
        DirectNode(args, lingers=True) as direct,
        MulticastSocket(args.group, args.port, args.ttl) as group,
    ):
        hello = _Hello(args, group)
        publisher = direct.node.create_publisher(String, args.topic, 10)
        direct.node.create_subscription(
            String, args.topic, lambda message: hello.hear("topic", message.data), 10
        )

        def greet() -> None:
            publisher.publish(String(data=hello.greeting))
            hello.greet()

        def report() -> None:
            print(hello.table())
            if args.once and not end.done():
                end.set_result(None)

        direct.node.create_timer(args.emit_period, greet)
        direct.node.create_timer(args.print_period, report)
        direct.result(end)


class _Hello:
    """Counts the greetings of one print period."""

    def __init__(self, args: argparse.Namespace, group: MulticastSocket) -> None:
        self._args = args
        self._group = group
        self._host = socket.gethostname()
        self._sent = 0
        self._heard: dict[str, Counter[str]] = {"topic": Counter(), "group": Counter()}
        #: ROS 2's own text: its last word is the host.
        self.greeting = f"hello, it's me {self._host}"

    def greet(self) -> None:
        """Send a datagram, and note those that have arrived."""
        self._group.send(self.greeting.encode())
        self._sent += 1
        for data, _ in self._group.received():
            self.hear("group", data.decode("utf-8", "replace"))

    def hear(self, way: str, text: str) -> None:
        """Note a greeting, unless it is our own."""
        host = text.rsplit(maxsplit=1)[-1] if text.split() else ""
        if host not in ("", self._host):
            self._heard[way][host] += 1

    def table(self) -> str:
        """Return a table of the messages received since the last one."""
        args: Any = self._args
        titles = {"topic": f"Topic {args.topic}", "group": f"Group {args.group}:{args.port}"}
        lines = [f"Greetings sent: {self._sent}"]
        for way, title in titles.items():
            lines.append(f"{title}: heard {len(self._heard[way])} other hosts")
            lines += [f"    {host:30} {count}" for host, count in sorted(self._heard[way].items())]
            self._heard[way].clear()
        self._sent = 0
        return "\n".join([*lines, "-" * _WIDTH])


@verb_of_module
class HelloVerb(VerbExtension):
    """Find out which hosts can hear each other."""
