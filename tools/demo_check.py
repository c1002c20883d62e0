"""`scripts/demo --check`: drives turtle1 through a square and checks that turtle2 followed."""

from __future__ import annotations

import math
import os
import sys
import threading
import time
from pathlib import Path
from typing import TYPE_CHECKING, Any

from demo import FOLLOWER, LEADER
from demo_launch import Launch, free_domain

from geometry_msgs.msg import Twist
from turtlewire import Buffer, msg, wire
from turtlewire.distro import KILTED, since
from turtlewire.errors import TransformException
from turtlewire.tf.listener import TransformListener
from turtlewire.wire.base import TypeId
from turtlewire.wire.qos import QoS

if TYPE_CHECKING:
    from turtlewire.wire import base

#: A side and a corner, four times: m/s, rad/s, s.
SQUARE = ((2.0, 0.0, 1.0), (0.0, math.pi / 2, 1.0)) * 4
#: How long turtle2 gets to arrive, and how near that is.
REST_S = 10.0
NEAR_M = 0.3
#: turtle2 has followed if its way was at least this share of turtle1's; it may cut corners.
SHARE_OF_WAY = 0.5
#: Longest wait for turtle2's first movement, and for the next message of each stream.
START_LIMIT_S = 30.0
SILENCE_LIMIT_S = 3.0
COMMAND_PERIOD_S = 0.1

#: What turtlesim sends.
_POSE = "turtlesim_msgs/msg/Pose" if since(KILTED) else "turtlesim/msg/Pose"


class CheckError(Exception):
    """Says why the demo does not work."""


def check(started: float) -> int:
    """Run the demo headless and judge it.

    Args:
        started: When the command was typed, seconds of ``time.time()``.

    Returns:
        The exit status: 0 when turtle2 followed and ended near turtle1.
    """
    reserved = free_domain()
    if reserved is None:
        print("[demo] failed: all ROS domains from 1 to 101 are in use", file=sys.stderr)
        return 1
    domain, _mark = reserved
    os.environ |= {"ROS_DOMAIN_ID": str(domain), "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST"}
    os.environ |= {"TURTLEWIRE_PORT": "0", "TURTLEWIRE_BROWSER": "0"}
    log = Path(os.environ["ROS_LOG_DIR"]) / f"demo-check-{os.getpid()}.txt"
    log.parent.mkdir(parents=True, exist_ok=True)
    with log.open("wb") as output:
        launch = Launch(output.fileno())
        try:
            print(
                f"[demo] checking in ROS domain {domain}; what the processes say goes to {log}",
                flush=True,
            )
            launch.start()
            with Observer(started) as observer:
                problem = judge(observer, launch)
                print(observer.figures(), flush=True)
        except KeyboardInterrupt:
            problem = "interrupted"
        finally:
            launch.stop()
    if problem:
        print(f"[demo] failed: {problem}", file=sys.stderr)
        return 1
    log.unlink()
    return 0


def judge(observer: Observer, launch: Launch) -> str:
    """Drive, wait and compare; the reason why it does not work, or an empty string."""
    try:
        observer.wait_for_first_movement(launch)
        print(f"[demo] {FOLLOWER} moves: driving {LEADER} through a square", flush=True)
        for forward, turn, duration in SQUARE:
            observer.drive(forward, turn, duration, launch)
        observer.drive(0.0, 0.0, REST_S, launch)
    except CheckError as error:
        return str(error)
    leader, follower = observer.tracks[LEADER], observer.tracks[FOLLOWER]
    if follower.way < SHARE_OF_WAY * leader.way:
        return f"{FOLLOWER} went {follower.way:.2f} m while {LEADER} went {leader.way:.2f} m"
    if observer.distance > NEAR_M:
        return f"{FOLLOWER} ended {observer.distance:.2f} m from {LEADER}, farther than {NEAR_M} m"
    return ""


class Track:
    """The position of a turtle, and the distance that it has driven since the first pose."""

    def __init__(self) -> None:
        self.x = self.y = math.nan
        self.way = 0.0

    def move(self, x: float, y: float) -> None:
        """Take the next pose."""
        if not math.isnan(self.x):
            self.way += math.hypot(x - self.x, y - self.y)
        self.x, self.y = x, y


class Observer:
    """Drives turtle1, and watches poses, transforms and the commands to turtle2."""

    def __init__(self, started: float) -> None:
        self.tracks = {LEADER: Track(), FOLLOWER: Track()}
        self.largest_distance = 0.0
        self.distance = math.inf
        self.lookups = 0
        self.first_movement_s = math.nan
        self._started = started
        self._moved = threading.Event()
        self._heard: dict[str, float] = {}
        self._context = wire.open_context()
        node = self._context.create_node("demo_check")
        for turtle in (LEADER, FOLLOWER):
            self._listen(node, f"/{turtle}/pose", _POSE, self._on_pose, turtle)
        self._listen(
            node,
            f"/{FOLLOWER}/cmd_vel",
            "geometry_msgs/msg/Twist",
            None,
            f"the listener's commands to {FOLLOWER}",
        )
        self._buffer = Buffer()
        self._listener = TransformListener(self._buffer, node, context=self._context)
        self._commands = node.create_publisher(
            f"/{LEADER}/cmd_vel", type_id("geometry_msgs/msg/Twist"), QoS()
        )

    def __enter__(self) -> Observer:  # noqa: PYI034 -- typing.Self comes with Python 3.11
        return self

    def __exit__(self, *_exception: object) -> None:
        self._listener.close()
        self._context.close()

    def _listen(
        self, node: base.Node, topic: str, type_name: str, on_message: Any, what: str
    ) -> None:
        message_class = msg.get_message(type_name)

        def receive(cdr: bytes, _info: base.MessageInfo) -> None:
            self._heard[what] = time.monotonic()
            if on_message is not None:
                on_message(what, msg.deserialize(message_class, cdr))

        node.create_subscription(topic, type_id(type_name), QoS(), receive)

    def _on_pose(self, turtle: str, pose: Any) -> None:
        leader, follower = self.tracks[LEADER], self.tracks[FOLLOWER]
        self.tracks[turtle].move(pose.x, pose.y)
        if not math.isnan(follower.x) and not math.isnan(leader.x):
            self.distance = math.hypot(leader.x - follower.x, leader.y - follower.y)
            self.largest_distance = max(self.largest_distance, self.distance)
        if turtle == FOLLOWER and not self._moved.is_set() and pose.linear_velocity > 0.0:
            self.first_movement_s = time.time() - self._started
            self._moved.set()

    def wait_for_first_movement(self, launch: Launch) -> None:
        """Block until turtle2 moves and its transform has arrived here.

        Raises:
            CheckError: turtle2 does not move, its transform does not arrive, or the launch ends.
        """
        deadline = time.monotonic() + START_LIMIT_S
        why = f"{FOLLOWER} did not move within {START_LIMIT_S:.0f} s"
        while not self._moved.wait(0.5) or (why := self._missing_transform()):
            if launch.ended.is_set():
                raise CheckError("the launch ended before anything moved")
            if time.monotonic() > deadline:
                raise CheckError(why)

    def _missing_transform(self) -> str:
        """Return why turtle2's transform has not arrived within half a second, or ""."""
        why = self._buffer.explain(FOLLOWER, LEADER, timeout_ns=500_000_000)
        return f"no transform of {FOLLOWER} arrives: {why}" if why else ""

    def drive(self, forward: float, turn: float, duration: float, launch: Launch) -> None:
        """Command turtle1 for some seconds, with a lookup between the turtles at each command.

        Raises:
            CheckError: A process or a stream of the demo has stopped.
        """
        twist = Twist()
        twist.linear.x, twist.angular.z = forward, turn
        end = time.monotonic() + duration
        while (remaining := end - time.monotonic()) > 0.0:
            self._commands.publish(msg.serialize(twist))
            self._look_up()
            if launch.ended.wait(min(COMMAND_PERIOD_S, remaining)):
                raise CheckError("the launch ended on the way")
            self._check_streams()

    def _look_up(self) -> None:
        try:
            newest_ns = self._buffer.lookup_transform(FOLLOWER, LEADER).stamp_ns
        except TransformException as error:
            raise CheckError(f"the transform between the turtles is not there: {error}") from error
        self.lookups += 1
        # the stamp is that of the turtle whose broadcaster has been silent for longer
        age_s = time.time() - (newest_ns or 0) / 1e9
        if age_s > SILENCE_LIMIT_S:
            raise CheckError(
                f"the newest transform between the turtles is {age_s:.1f} s old: "
                "a broadcaster has stopped"
            )

    def _check_streams(self) -> None:
        now = time.monotonic()
        for what, heard in list(self._heard.items()):
            if now - heard > SILENCE_LIMIT_S:
                raise CheckError(f"no messages of {what} for {now - heard:.1f} s")

    def figures(self) -> str:
        """Return the measured figures in one line."""
        return (
            f"largest distance {self.largest_distance:.2f} m, final distance {self.distance:.3f} "
            "m, "
            f"{self.lookups} lookups, "
            f"{self.first_movement_s:.2f} s from the command to {FOLLOWER}'s first movement"
        )


def type_id(name: str) -> TypeId:
    """Return the name and hash by which peers identify a message type."""
    return TypeId(name, msg.type_hash(name))
