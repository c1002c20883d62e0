"""``ros2 doctor hello``."""

from __future__ import annotations

import argparse
import os
import re
import socket
from collections import Counter
from contextlib import ExitStack, suppress
from typing import TYPE_CHECKING, Any

from rclpy.qos import QoSProfile
from ros2cli.arguments import argument, positive, positive_int
from ros2cli.discovery import SPIN_ARGUMENTS
from ros2doctor.verb import VerbExtension
from ros2multicast.api import DEFAULT_GROUP, DEFAULT_PORT, GROUP_ARGUMENTS, MulticastSocket

if TYPE_CHECKING:
    from rclpy.node import Node

__all__ = [
    "ARGUMENTS",
    "DEFAULT_GROUP",
    "DEFAULT_PORT",
    "NODE_NAME_PREFIX",
    "HelloMulticastUDPReceiver",
    "HelloMulticastUDPSender",
    "HelloPublisher",
    "HelloSubscriber",
    "HelloVerb",
    "SummaryTable",
    "main",
    "positive",
    "positive_float",
    "positive_int",
]

#: Begins the name of the node; the host's name may have characters that no node's name has.
NODE_NAME_PREFIX = f"ros2doctor_{re.sub(r'[^a-zA-Z0-9]', '_', socket.gethostname())}_{os.getpid()}"

_WIDTH = 60
_QOS = QoSProfile(depth=10)

positive_float = positive(float)

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
    """Greet the other hosts and print a table of the received greetings, until Ctrl-C."""
    HelloVerb().main(args=args)


class HelloVerb(VerbExtension, module=__name__):
    """Find out which hosts can hear each other."""

    def main(self, *, args: Any, summary_table: SummaryTable | None = None) -> None:
        """Greet the other hosts, and print the counts of each period.

        Args:
            args: The command line.
            summary_table: Counts the greetings, by default a new one.
        """
        from rclpy.task import Future
        from ros2cli.node.direct import DirectNode

        table = SummaryTable() if summary_table is None else summary_table
        end = Future()
        with (
            DirectNode(args, node_name=f"{NODE_NAME_PREFIX}_node", lingers=True) as direct,
            ExitStack() as opened,
        ):
            publisher = HelloPublisher(direct.node, args.topic, table)
            HelloSubscriber(direct.node, args.topic, table)
            receiver = HelloMulticastUDPReceiver(table, args.group, args.port)
            opened.callback(receiver.shutdown)
            sender = HelloMulticastUDPSender(table, args.group, args.port, args.ttl)
            opened.callback(sender.shutdown)

            def greet() -> None:
                publisher.publish()
                sender.send()
                receiver.recv()

            def report() -> None:
                table.format_print_summary(
                    args.topic, args.print_period, group=args.group, port=args.port
                )
                table.reset()
                if args.once and not end.done():
                    end.set_result(None)

            direct.node.create_timer(args.emit_period, greet)
            direct.node.create_timer(args.print_period, report)
            direct.result(end)


class SummaryTable:
    """Counts the greetings of one print period."""

    def __init__(self) -> None:
        self.reset()

    def reset(self) -> None:
        """Set all counts to zero."""
        self._published = 0
        self._sent = 0
        self._heard: dict[str, Counter[str]] = {"topic": Counter(), "group": Counter()}

    def increment_pub(self) -> None:
        """Count a message that was published."""
        self._published += 1

    def increment_send(self) -> None:
        """Count a datagram that was sent."""
        self._sent += 1

    def increment_sub(self, hostname: str) -> None:
        """Count a message of another host."""
        self._heard["topic"][hostname] += 1

    def increment_receive(self, hostname: str) -> None:
        """Count a datagram of another host."""
        self._heard["group"][hostname] += 1

    def format_print_summary(
        self,
        topic: str,
        print_period: float,
        *,
        group: str = DEFAULT_GROUP,
        port: int = DEFAULT_PORT,
    ) -> None:
        """Print the counts.

        Args:
            topic: Name of the topic.
            print_period: Seconds that were counted.
            group: Multicast group of the datagrams.
            port: UDP port of the datagrams.
        """
        titles = {"topic": f"Topic {topic}", "group": f"Group {group}:{port}"}
        lines = [f"Greetings in {print_period} s: {self._published} published, {self._sent} sent"]
        for way, title in titles.items():
            lines.append(f"{title}: heard {len(self._heard[way])} other hosts")
            lines += [f"    {host:30} {count}" for host, count in sorted(self._heard[way].items())]
        print("\n".join([*lines, "-" * _WIDTH]))


class HelloPublisher:
    """Publishes greetings.

    Args:
        node: The node.
        topic: Name of the topic.
        summary_table: Counts the messages.
        qos: Quality of service.
    """

    def __init__(
        self, node: Node, topic: str, summary_table: SummaryTable, *, qos: QoSProfile = _QOS
    ) -> None:
        from std_msgs.msg import String

        self._summary_table = summary_table
        self._message = String(data=_greeting())
        self._publisher = node.create_publisher(String, topic, qos)

    def publish(self) -> None:
        """Publish a greeting."""
        self._publisher.publish(self._message)
        self._summary_table.increment_pub()

    def destroy(self) -> None:
        """Destroy the publisher."""
        self._publisher.destroy()


class HelloSubscriber:
    """Counts the greetings of other hosts on a topic.

    Args:
        node: The node.
        topic: Name of the topic.
        summary_table: Counts the messages.
        qos: Quality of service.
    """

    def __init__(
        self, node: Node, topic: str, summary_table: SummaryTable, *, qos: QoSProfile = _QOS
    ) -> None:
        from std_msgs.msg import String

        self._summary_table = summary_table
        self._subscription = node.create_subscription(String, topic, self._hear, qos)

    def _hear(self, message: Any) -> None:
        if host := _other_host(message.data):
            self._summary_table.increment_sub(host)

    def destroy(self) -> None:
        """Destroy the subscription."""
        self._subscription.destroy()


class HelloMulticastUDPSender:
    """Sends greetings as datagrams.

    Args:
        summary_table: Counts them.
        group: Multicast group.
        port: UDP port.
        ttl: How many routers they may pass; None leaves it to the system.
    """

    def __init__(
        self,
        summary_table: SummaryTable,
        group: str = DEFAULT_GROUP,
        port: int = DEFAULT_PORT,
        ttl: int | None = None,
    ) -> None:
        self._summary_table = summary_table
        self._opened = ExitStack()
        self._socket = self._opened.enter_context(MulticastSocket(group, port, ttl))

    def send(self) -> None:
        """Send a greeting."""
        self._socket.send(_greeting().encode())
        self._summary_table.increment_send()

    def shutdown(self) -> None:
        """Close the socket."""
        self._opened.close()


class HelloMulticastUDPReceiver:
    """Counts the greetings of other hosts that arrive as datagrams.

    Args:
        summary_table: Counts them.
        group: Multicast group.
        port: UDP port.
        timeout: Seconds that :meth:`recv` waits for one; None does not wait.
    """

    def __init__(
        self,
        summary_table: SummaryTable,
        group: str = DEFAULT_GROUP,
        port: int = DEFAULT_PORT,
        timeout: float | None = None,
    ) -> None:
        self._summary_table = summary_table
        self._timeout = timeout
        self._opened = ExitStack()
        self._socket = self._opened.enter_context(MulticastSocket(group, port))

    def recv(self) -> None:
        """Count the datagrams that have arrived."""
        if self._timeout is not None:
            with suppress(TimeoutError):
                self._count(self._socket.receive(self._timeout)[0])
        for data, _ in self._socket.received():
            self._count(data)

    def _count(self, data: bytes) -> None:
        if host := _other_host(data.decode("utf-8", "replace")):
            self._summary_table.increment_receive(host)

    def shutdown(self) -> None:
        """Close the socket."""
        self._opened.close()


def _greeting() -> str:
    """Return ROS 2's own text, whose last word is the host."""
    return f"hello, it's me {socket.gethostname()}"


def _other_host(text: str) -> str:
    """Return the host that has sent a greeting; empty for this one, or for something else."""
    host = text.rsplit(maxsplit=1)[-1] if text.split() else ""
    return "" if host == socket.gethostname() else host
