"""`ros2 run tf2_ros tf2_monitor [SOURCE TARGET]`: delays, rates and publishers of transforms."""

from __future__ import annotations

import json
import sys
import threading
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import rclpy
from rclpy.node import Node
from rclpy.time import Time
from rclpy.utilities import remove_ros_args
from tf2_py.buffer_core import way
from turtlewire import msg
from turtlewire.errors import TransformException
from turtlewire.terminal.parser import seconds
from turtlewire.terminal.printable import printable_lines
from turtlewire.tf.links import links
from turtlewire.tf.listener import QOS, STATIC_QOS, STATIC_TOPIC, TOPIC, TYPE_NAME
from turtlewire.wire.base import TypeId

from .buffer import Buffer
from .command_line import ToolParser, count, frame_id
from .transform_listener import spin_in_thread

if TYPE_CHECKING:
    import argparse

    from turtlewire.wire.base import MessageInfo

#: ROS 2's name for a publisher whose node is unknown.
NOBODY = "<no authority available>"


class Delays:
    """Count, mean and maximum of delays, in seconds."""

    def __init__(self) -> None:
        self.count = 0
        self.total = self.maximum = 0.0

    def add(self, seconds: float) -> None:
        """Add one delay."""
        self.count += 1
        self.total += seconds
        # Delays may be negative, so that the first one may be the largest.
        self.maximum = seconds if self.count == 1 else max(self.maximum, seconds)

    def merge(self, other: Delays) -> None:
        """Add all delays of another instance."""
        self.maximum = max(
            (delays.maximum for delays in (self, other) if delays.count), default=0.0
        )
        self.count += other.count
        self.total += other.total

    @property
    def mean(self) -> float:
        """The mean; 0 without values."""
        return self.total / self.count if self.count else 0.0


class DelayStatistics:
    """Delays by frame and by publisher. Thread-safe.

    Args:
        name_of: Returns the name of a publisher's node for a gid.
        now: Returns the present time [s], from which delays are measured.
        is_present: Returns True while the graph has the publisher with a gid.
    """

    def __init__(
        self,
        name_of: Callable[[bytes], str],
        now: Callable[[], float],
        is_present: Callable[[bytes], bool],
    ) -> None:
        self._name_of = name_of
        self._is_present = is_present
        self._now = now
        self._lock = threading.Lock()
        self._names: dict[bytes, str] = {}
        self._frames: dict[str, tuple[bytes, Delays]] = {}
        self._publishers: dict[bytes, tuple[Delays, list[float]]] = {}

    def take(self, message: Any, info: MessageInfo) -> None:
        """Count a ``TFMessage``."""
        gid, now = info.publisher_gid, self._now()
        with self._lock:
            self._name(gid)  # later the publisher may have left the graph
            delays, span = self._publishers.setdefault(gid, (Delays(), [now, now]))
            span[1] = now
            of_message = Delays()
            for transform in message.transforms:
                delay = now - (transform.header.stamp.sec + transform.header.stamp.nanosec / 1e9)
                of_message.add(delay)
                _, of_frame = self._frames.get(transform.child_frame_id, (gid, Delays()))
                of_frame.add(delay)
                self._frames[transform.child_frame_id] = (gid, of_frame)
            delays.add(of_message.mean)  # as in ROS 2, a broadcaster's statistics count messages

    def _name(self, gid: bytes) -> str:
        """Return the node of a publisher, whose first message may arrive before it is known."""
        name = self._names.get(gid) or self._name_of(gid)
        if name != NOBODY:
            self._names[gid] = name
        return name

    def as_dict(self) -> dict[str, Any]:
        """Return the statistics as plain data, in seconds and hertz."""
        with self._lock:
            of_node: dict[str, tuple[Delays, list[float]]] = {}
            for gid, (delays, span) in self._publishers.items():
                all_delays, all_span = of_node.setdefault(self._name(gid), (Delays(), list(span)))
                all_delays.merge(delays)
                all_span[:] = min(all_span[0], span[0]), max(all_span[1], span[1])
            return {
                "frames": [
                    {
                        "frame": frame,
                        "published_by": self._name(gid),
                        "departed": not self._is_present(gid),
                        "average_delay": delays.mean,
                        "max_delay": delays.maximum,
                    }
                    for frame, (gid, delays) in self._frames.items()
                ],
                "broadcasters": [
                    {
                        "node": name,
                        "rate": _rate(delays, span),
                        "average_delay": delays.mean,
                        "max_delay": delays.maximum,
                    }
                    for name, (delays, span) in of_node.items()
                ],
            }


def _rate(delays: Delays, span: list[float]) -> float:
    return (delays.count - 1) / (span[1] - span[0]) if span[1] > span[0] else 0.0


def main(args: list[str] | None = None) -> int:
    """Gather and report until stopped; return the exit status."""
    argv = sys.argv if args is None else args
    options = _parser().parse_args(remove_ros_args(argv)[1:])
    if len(options.frames) not in {0, 2}:
        print("tf2_monitor: give two frames, or none to monitor all", file=sys.stderr)  # noqa: T201
        return 1
    rclpy.init(args=argv)
    try:
        with Node("tf2_monitor") as node:
            # A simulated clock needs the spinning.
            executor, thread = spin_in_thread(node, "tf2-monitor")
            try:
                _monitor(node, options)
            finally:
                executor.shutdown()
                thread.join()
    except KeyboardInterrupt:
        pass
    finally:
        rclpy.try_shutdown()
    return 0


def _parser() -> argparse.ArgumentParser:
    parser = ToolParser(
        prog="tf2_monitor",
        description="Report the delays, the rates and the publishers of transforms.",
    )
    parser.add_argument(
        "frames",
        nargs="*",
        type=frame_id,
        metavar="FRAME",
        help="the two ends of the chain to monitor (default: monitor all frames)",
    )
    parser.add_argument(
        "--period",
        type=seconds,
        default=10.0,
        help="seconds between reports (default: %(default)s)",
    )
    parser.add_argument("-n", "--limit", type=count, default=0, help="exit after this many reports")
    parser.add_argument(
        "--json", action="store_true", help="one JSON object in a line for each report"
    )
    return parser


def _monitor(node: Node, options: argparse.Namespace) -> None:
    buffer, stopped = Buffer(node=node), threading.Event()
    rclpy.get_default_context().on_shutdown(stopped.set)
    clock = node.get_clock()
    statistics = DelayStatistics(
        lambda gid: _publisher_name(node, gid),
        lambda: clock.now().nanoseconds / 1e9,
        lambda gid: any(gid == endpoint.gid for endpoint in node.context.wire.graph.endpoints()),
    )
    net = Delays()
    _subscribe(node, buffer, statistics, lambda: _note_chain(options.frames, buffer, net, clock))
    if not options.json:
        what = "the chain" if options.frames else "all frames"
        text = f"Gathering data on {what} for {options.period:g} seconds..."
        print(text, flush=True)  # noqa: T201
    reports = 0
    while not stopped.wait(options.period):
        print(_report(options, buffer, statistics, net), flush=True)  # noqa: T201
        reports += 1
        if reports == options.limit:
            return


def _subscribe(
    node: Node, buffer: Buffer, statistics: DelayStatistics, on_data: Callable[[], None]
) -> None:
    message_class = msg.get_message(TYPE_NAME)
    type_id = TypeId(TYPE_NAME, msg.type_hash(TYPE_NAME))
    for topic, qos in ((TOPIC, QOS), (STATIC_TOPIC, STATIC_QOS)):

        def receive(cdr: bytes, info: MessageInfo, *, static: bool = topic == STATIC_TOPIC) -> None:
            # One subscription serves the buffer and the statistics.
            buffer.engine.add_tf_message(cdr, static=static)
            statistics.take(msg.deserialize(message_class, cdr), info)
            on_data()

        # Below rclpy, whose message info has no publisher gid.
        node._rclpy_wire.create_subscription(node.resolve_topic_name(topic), type_id, qos, receive)


def _publisher_name(node: Node, gid: bytes) -> str:
    for endpoint in node.context.wire.graph.endpoints():
        if endpoint.gid == gid and endpoint.node is not None:
            return f"{endpoint.node.namespace.rstrip('/')}/{endpoint.node.name}"
    return NOBODY


def _note_chain(frames: list[str], buffer: Buffer, net: Delays, clock: Any) -> None:
    if frames:
        try:
            stamp_ns = buffer.engine._latest_common_time(frames[1], frames[0])
        except TransformException:
            return  # not connected yet
        if stamp_ns:  # a static chain has no delay
            net.add((clock.now().nanoseconds - stamp_ns) / 1e9)


def chain(buffer: Buffer, source: str, target: str) -> list[str]:
    """Return the frames from one frame to another, both included.

    Raises:
        TransformException: The frames are not connected.
    """
    buffer.lookup_transform(target, source, Time())
    return way(
        {link.child_frame: link.parent_frame for link in links(buffer.engine)}, source, target
    )


def _report(
    options: argparse.Namespace, buffer: Buffer, statistics: DelayStatistics, net: Delays
) -> str:
    data = statistics.as_dict()
    way: list[str] = []
    if options.frames:
        try:
            way = chain(buffer, *options.frames)
        except TransformException as error:
            data |= {"error": str(error), "hint": error.hint}
        data |= {"chain": way, "net_delay": {"average": net.mean, "max": net.maximum}}
        data["frames"] = [entry for entry in data["frames"] if entry["frame"] in way]
    if options.json:
        return json.dumps(data)
    return printable_lines(_in_lines(options.frames, data))


def _in_lines(frames: list[str], data: dict[str, Any]) -> str:
    """Return a report in ROS 2's words."""
    lines = ["", ""]
    if frames:
        net = data["net_delay"]
        lines += [f"RESULTS: for {frames[0]} to {frames[1]}"]
        lines += (
            [*filter(None, (data["error"], data["hint"]))]
            if "error" in data
            else [f"Chain is: {' -> '.join(data['chain'])}"]
        )
        lines += [
            f"Net delay     avg = {net['average']:g}: max = {net['max']:g}",
        ]
    else:
        lines += ["RESULTS: for all Frames"]
    lines += ["", "Frames:"]
    lines += [
        f"Frame: {entry['frame']}, published by {entry['published_by']}"
        f"{' (has left)' if entry['departed'] else ''}, "
        f"Average Delay: {entry['average_delay']:g}, Max Delay: {entry['max_delay']:g}"
        for entry in data["frames"]
    ]
    lines += ["", "All Broadcasters:"]
    lines += [
        f"Node: {entry['node']} {entry['rate']:g} Hz, "
        f"Average Delay: {entry['average_delay']:g} Max Delay: {entry['max_delay']:g}"
        for entry in data["broadcasters"]
    ]
    return "\n".join(lines)
