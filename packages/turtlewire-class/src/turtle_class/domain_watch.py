"""The state of one student's domain for the page: nodes, turtles, transforms and problems.

Python does not handle poses and transforms one by one: the middleware keeps the newest pose of a
turtle, and the native buffer stores the transforms. So thirty domains need little CPU.
"""

from __future__ import annotations

import math
import struct
import threading
import time
from typing import TYPE_CHECKING, Any

from turtlesim.transform_view import TransformView
from turtlewire import msg
from turtlewire.doctor.graph_findings import graph_findings
from turtlewire.doctor.tf_findings import tf_findings
from turtlewire.doctor.tf_traffic import TfListener, tf_publishers
from turtlewire.terminal.printable import printable
from turtlewire.wire import open_context
from turtlewire.wire.base import TypeId
from turtlewire.wire.names import fully_qualified_node_name, is_hidden, validate_full_topic_name
from turtlewire.wire.qos import QoS, Reliability

if TYPE_CHECKING:
    from turtle_class.roster import Seat
    from turtlewire.doctor.finding import Finding
    from turtlewire.wire.base import Subscription

__all__ = ["DomainWatch"]

_POSE = "turtlesim/msg/Pose"
_POSE_NUMBERS = struct.Struct("<5f")
#: Further turtles are not drawn, and longer names not shown: a student may spawn thousands.
_MOST_TURTLES, _MOST_NODES, _LONGEST_NAME = 12, 20, 80
_STALE_S = 3.0
#: A tree of more frames, or with longer names in all, is not kept: a program that makes up a name
#: for each message would fill the memory.
_MOST_FRAMES, _MOST_LETTERS = 500, 50_000
_NODE = "_turtlewire_class"

_FLOOD = {
    "text": f"More than {_MOST_FRAMES} frames, or very long names: stopped listening to TF.",
    "remedy": "child_frame_id must be the same in each message, without a counter or time. "
    "Restart the node to listen to TF again.",
    "bad": True,
}


class DomainWatch:
    """Watches one domain until it is closed. :meth:`picture` is for one thread.

    Args:
        seat: Whose domain it is.

    Raises:
        WireError: The domain cannot be joined.
    """

    def __init__(self, seat: Seat) -> None:
        self.seat = seat
        self._context = open_context(seat.domain)
        self._node = self._context.create_node(_NODE)
        self._transforms = TransformView(self._context, "/", time.time_ns)
        self._listens = False
        self._flooded = False
        self._poses: dict[str, Subscription] = {}
        self._turtles: dict[str, tuple[float, float, float]] = {}
        self._active: float | None = None
        self._nodes: list[str] = []
        self._frames: dict[str, Any] = {}
        self._finding: Finding | None = None
        self._changed = threading.Event()
        self._changed.set()
        self._end_listening = self._context.graph.add_listener(self._changed.set)

    def close(self) -> None:
        """Leave the domain."""
        self._end_listening()
        self._transforms.close()
        self._context.close()

    def picture(self, *, fresh: bool) -> dict[str, Any]:
        """Return the state as JSON values; ``fresh`` also reads the tree of frames."""
        if self._changed.is_set():
            self._changed.clear()
            self._take_graph()
        self._listen(bool(self._nodes) and not self._flooded)
        self._take_poses()
        if fresh and self._listens:
            self._take_frames()
        idle = None if self._active is None else round(time.monotonic() - self._active)
        return {
            "name": self.seat.name,
            "domain": self.seat.domain,
            "nodes": self._nodes[:_MOST_NODES],
            "count": len(self._nodes),
            "turtles": [[_shown(name), *place] for name, place in self._turtles.items()],
            "frames": None if self._flooded else len(self._frames),
            "follow": self._distance(),
            "idle": idle,
            "problem": self._problem(),
        }

    def rest(self) -> None:
        """Stop reading transforms until the next picture, because no page is open."""
        self._listen(False)

    def examine(self, ended: threading.Event, seconds: float) -> None:
        """Listen as the doctor does, and keep the most important finding.

        Args:
            ended: Ends the listening early when it is set.
            seconds: How long to listen.
        """
        if not self._nodes:
            return
        graph = self._context.graph
        listener = TfListener(self._context)
        try:
            if tf_publishers(graph) and not self._flooded:
                ended.wait(seconds)
        finally:
            traffic = listener.close()
        found = [*graph_findings(graph), *tf_findings(graph, traffic)]
        self._finding = min(found, key=lambda finding: not finding.is_problem, default=None)

    def _take_graph(self) -> None:
        graph = self._context.graph
        names = [fully_qualified_node_name(node.name, node.namespace) for node in graph.nodes()]
        nodes = sorted(_shown(name) for name in names if not is_hidden(name))
        if nodes != self._nodes:
            self._active = time.monotonic()
            self._flooded = False  # it may be repaired
        self._nodes = nodes
        topics = sorted(
            {
                end.topic
                for end in graph.endpoints()
                if end.kind == "publisher"
                and end.type_name == _POSE
                and end.topic.endswith("/pose")
            }
        )[:_MOST_TURTLES]
        for topic in self._poses.keys() - set(topics):
            self._poses.pop(topic).close()
            self._turtles.pop(_turtle(topic), None)
        for topic in topics:
            if topic not in self._poses and validate_full_topic_name(topic) is None:
                self._poses[topic] = self._subscribe(topic)

    def _listen(self, wanted: bool) -> None:
        if wanted and not self._listens:
            self._transforms.join()
        elif self._listens and not wanted:
            self._transforms.leave()
            self._frames = {}
        self._listens = wanted

    def _take_frames(self) -> None:
        frames = self._transforms.frames()
        letters = sum(len(frame.name) for frame in frames)
        if len(frames) > _MOST_FRAMES or letters > _MOST_LETTERS:
            self._flooded = True
            self._listen(False)
        else:
            self._frames = {frame.name: frame for frame in frames}

    def _problem(self) -> dict[str, Any] | None:
        if self._flooded:
            return _FLOOD
        finding = self._finding if self._nodes else None
        return None if finding is None else _as_words(finding, self.seat)

    def _subscribe(self, topic: str) -> Subscription:
        kind = TypeId(_POSE, msg.type_hash(_POSE))
        qos = QoS(depth=1, reliability=Reliability.BEST_EFFORT)
        return self._node.create_subscription(topic, kind, qos)

    def _take_poses(self) -> None:
        for topic, subscription in self._poses.items():
            for cdr, _ in subscription.take():
                if len(cdr) < 4 + _POSE_NUMBERS.size or not cdr[1] & 1:
                    continue  # not what turtlesim sends
                place = _POSE_NUMBERS.unpack_from(cdr, 4)[:3]
                if all(map(math.isfinite, place)) and place != self._turtles.get(_turtle(topic)):
                    self._turtles[_turtle(topic)] = place
                    self._active = time.monotonic()

    def _distance(self) -> float | None:
        """Return turtle2's distance from turtle1 by TF [m]; None if TF does not have it now."""
        frames = [self._frames.get(name) for name in ("turtle1", "turtle2")]
        if not all(frame and (frame.age is None or frame.age < _STALE_S) for frame in frames):
            return None
        place = self._transforms.relation("turtle2", "turtle1").get("translation")
        if place is None or None in place:
            return None
        return round(math.hypot(place[0], place[1]), 2)


def _turtle(topic: str) -> str:
    return topic.removeprefix("/").removesuffix("/pose")


def _shown(name: str) -> str:
    text = printable(name)
    return text if len(text) <= _LONGEST_NAME else f"{text[:_LONGEST_NAME]}…"


def _as_words(finding: Finding, seat: Seat) -> dict[str, Any]:
    remedy = finding.remedy
    if "have the same name /turtlesim." in finding.text:
        remedy = (
            f"Either turtlesim was started twice, or two students use ROS_DOMAIN_ID={seat.domain}."
        )
    return {
        "text": printable(finding.text)[:400],
        "remedy": printable(remedy)[:400],
        "bad": finding.is_problem,
    }
