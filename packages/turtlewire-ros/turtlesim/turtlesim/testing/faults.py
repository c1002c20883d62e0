"""Faults of transforms for practice: typical TF problems of robots, switched on in a test.

::

    with Simulation() as simulation:
        ...
        simulation.inject(Delay(1.5, frame="turtle1"))
        simulation.run(5.0)  # turtle2 follows where turtle1 was
        simulation.clear_faults()

Every fault acts between the broadcasters and the listeners: the nodes stay unchanged, and each run
is the same.
"""

from __future__ import annotations

import heapq
import itertools
import random
from typing import TYPE_CHECKING, Any

from geometry_msgs.msg import TransformStamped
from rclpy.node import Node
from tf2_ros import TransformBroadcaster
from turtlewire import msg

if TYPE_CHECKING:
    from turtlesim.testing.stage import Stage
    from turtlewire.wire.local.bus import Bus, LocalSender, Message

_TF_TYPE = "tf2_msgs/msg/TFMessage"
_STATIC = "/tf_static"
_TOPICS = {"/tf", _STATIC}


class Fault:
    """A fault in the transport of transforms. Each subclass changes one property.

    Args:
        frame: The child frame that it is about; None means all.
    """

    def __init__(self, frame: str | None = None) -> None:
        self.frame = frame

    def begin(self, nodes: Stage) -> None:
        """The fault is switched on."""

    def end(self, nodes: Stage) -> None:
        """The fault is switched off."""

    def concerns(self, transform: Any, topic: str) -> bool:
        """Return True if it is about this transform."""
        return topic == "/tf" and self.frame in {None, transform.child_frame_id}

    def delay_s(self, transform: Any) -> float | None:
        """Change the transform; how much later it arrives [s], or None if it never does."""
        raise NotImplementedError


class Delay(Fault):
    """Transforms arrive late, as over a slow radio link.

    Args:
        seconds: How late, in simulated time.
        frame: The child frame; None means all.
    """

    def __init__(self, seconds: float, frame: str | None = None) -> None:
        super().__init__(frame)
        self._seconds = seconds

    def delay_s(self, transform: Any) -> float:  # noqa: ARG002 - all alike
        return self._seconds


class Loss(Fault):
    """Transforms get lost at random, the same ones in each run.

    Args:
        share: The part that is lost, 0 to 1.
        frame: The child frame; None means all.
        seed: Another number loses others.
    """

    def __init__(self, share: float, frame: str | None = None, *, seed: int = 1) -> None:
        super().__init__(frame)
        if not 0.0 <= share <= 1.0:
            raise ValueError(f"the share that is lost must be from 0 to 1, not {share}")
        self._share = share
        self._random = random.Random(seed)  # noqa: S311 - a test's

    def delay_s(self, transform: Any) -> float | None:  # noqa: ARG002 - all alike
        return None if self._random.random() < self._share else 0.0


class WrongFrame(Fault):
    """Transforms name another parent, as after a typing error.

    Args:
        frame: The child frame.
        parent: The parent that they name.
    """

    def __init__(self, frame: str, parent: str) -> None:
        super().__init__(frame)
        self._parent = parent

    def delay_s(self, transform: Any) -> float:
        transform.header.frame_id = self._parent
        return 0.0


class WrongTime(Fault):
    """Stamps are off, as between two hosts whose clocks differ.

    Args:
        seconds: How far the stamps are in the future; below zero: in the past, where they end at
            zero.
        frame: The child frame; None means all.
    """

    def __init__(self, seconds: float, frame: str | None = None) -> None:
        super().__init__(frame)
        self._offset_ns = round(seconds * 1e9)

    def delay_s(self, transform: Any) -> float:
        stamp = transform.header.stamp
        total = stamp.sec * 1_000_000_000 + stamp.nanosec + self._offset_ns
        stamp.sec, stamp.nanosec = divmod(max(0, total), 1_000_000_000)
        return 0.0


class MissingStatic(Fault):
    """Static transforms do not arrive, as when their broadcaster was not started.

    Listeners that have already received them keep them: inject it before the broadcaster
    starts.

    Args:
        frame: The child frame; None means all.
    """

    def concerns(self, transform: Any, topic: str) -> bool:
        return topic == _STATIC and self.frame in {None, transform.child_frame_id}

    def delay_s(self, transform: Any) -> None:
        """Return the delay of a transform [s]; None if it never arrives."""


class TwoPublishers(Fault):
    """A second node publishes the same frame, at another place.

    Args:
        frame: The child frame.
        parent: Its parent.
        x: Where the second node says it is [m].
        y: Likewise [m].
    """

    def __init__(
        self, frame: str, parent: str = "world", *, x: float = 1.0, y: float = 1.0
    ) -> None:
        super().__init__(frame)
        self._parent, self._x, self._y = parent, x, y
        self._node: Node | None = None

    def begin(self, nodes: Stage) -> None:
        """Start the second node."""
        node = self._node = nodes.start(lambda: Node("second"), name="second_broadcaster")
        broadcaster = TransformBroadcaster(node)

        def send() -> None:
            transform = TransformStamped()
            transform.header.stamp = node.get_clock().now().to_msg()
            transform.header.frame_id, transform.child_frame_id = self._parent, str(self.frame)
            transform.transform.translation.x = self._x
            transform.transform.translation.y = self._y
            transform.transform.rotation.w = 1.0
            broadcaster.sendTransform(transform)

        node.create_timer(0.1, send)

    def end(self, nodes: Stage) -> None:
        """End the second node."""
        if self._node is not None:
            nodes.remove(self._node)
            self._node = None

    def concerns(self, transform: Any, topic: str) -> bool:  # noqa: ARG002 - of none
        """Return True for transforms of this frame; others stay as they are."""
        return False


class FaultyTransforms:
    """Applies the faults that are switched on to the messages of a bus.

    Args:
        bus: Of the simulation's domain.
    """

    def __init__(self, bus: Bus) -> None:
        self._bus = bus
        self._held: list[tuple[float, int, LocalSender, Message]] = []
        self._numbers = itertools.count()
        self._now = 0.0
        self.faults: list[Fault] = []

    def listen(self) -> None:
        """Stand between publishers and subscriptions from now on."""
        self._bus.tamper = self._tamper

    def close(self) -> None:
        """Let messages pass again; drop the held ones."""
        self._bus.tamper = None
        self._held.clear()

    def advance(self, now: float) -> None:
        """Deliver what is due at this simulated time [s]."""
        self._now = now
        # Times are sums of steps, so a rounding error must not hold a message for another step.
        while self._held and self._held[0][0] <= now + 1e-9:
            _, _, sender, message = heapq.heappop(self._held)
            sender.deliver(message)

    def _tamper(self, sender: LocalSender, message: Message) -> None:
        if sender.topic not in _TOPICS or not self.faults:
            sender.deliver(message)
            return
        kind = msg.get_message(_TF_TYPE)
        cdr, info = message
        heard: Any = msg.deserialize(kind, cdr)
        for transform in heard.transforms:
            delay = self._delay(transform, sender.topic)
            if delay is None:
                continue
            # A message for each transform, because each may have another delay.
            changed = (msg.serialize(kind(transforms=[transform])), info)
            if delay > 0.0:
                # The number keeps the order of equal times, and senders cannot be compared.
                item = (self._now + delay, next(self._numbers), sender, changed)
                heapq.heappush(self._held, item)
            else:
                sender.deliver(changed)

    def _delay(self, transform: Any, topic: str) -> float | None:
        """Return a transform's delay after all faults [s]; None if it never arrives."""
        total = 0.0
        for fault in self.faults:
            if fault.concerns(transform, topic):
                delay = fault.delay_s(transform)
                if delay is None:
                    return None
                total += delay
        return total
