"""Records topics: bytes from the wire into a bag."""

from __future__ import annotations

import threading
import time
from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING

from rclpy.clock import JumpThreshold
from rclpy.duration import Duration
from rclpy.logging import get_logger
from rosbag2_transport.recorder_notices import missing
from rosbag2_transport.recorder_qos import misses, refusal, subscription_qos
from rosbag2_transport.topic_filter import TopicFilter
from turtlewire.bag.definitions import known_hash
from turtlewire.errors import BagError, WireError
from turtlewire.package_sources import source_hint
from turtlewire.terminal.printable import printable
from turtlewire.wire.base import Subscription, TypeId
from turtlewire.wire.qos import Durability

if TYPE_CHECKING:
    from rclpy.clock import TimeJump
    from rclpy.node import Node
    from rosbag2_transport.options import RecordOptions
    from turtlewire.bag.recording import Recording
    from turtlewire.wire.base import EndpointInfo, Entity
    from turtlewire.wire.qos import QoS

#: How long the first look at the graph may wait for it to be complete.
_DISCOVERY_NS = 1_000_000_000
_BATCH = 1000
#: How much is taken when a recording is paused or ends while messages keep coming.
_MOST_BATCHES = 100


class BagRecorder:
    """Subscribes to topics as they appear and writes their messages.

    One thread looks for topics whenever the graph changes, another takes messages. Latched messages
    that arrive during a pause are written when it ends.

    Args:
        node: The node whose subscriptions it uses.
        recording: The bag.
        options: Options of the recording.
        static: Types of the topics that are subscribed to at once, by topic.

    Raises:
        RuntimeError: A pattern is not a regular expression.
    """

    def __init__(
        self,
        node: Node,
        recording: Recording,
        options: RecordOptions,
        static: Mapping[str, str] | None = None,
    ) -> None:
        self._node = node
        self._logger = node.get_logger()
        self._recording = recording
        self._options = options
        self._static = static or {}
        self._filter = TopicFilter(options, self._complain)
        self._graph = node.context.wire.graph
        self._wait_set = node.context.wire.create_wait_set()
        self._subscriptions: dict[str, Subscription] = {}
        self._requested: dict[str, QoS] = {}
        self._refused: set[str] = set()
        self._known_publishers: set[bytes] = set()
        self._latched: list[tuple[str, bytes, int]] = []
        self._taking = threading.Lock()  # guards taking, the pause and messages held during it
        self._is_closed = False
        self._paused = options.start_paused
        self._stopped = threading.Event()
        self._graph_changed = threading.Event()
        self._taker = threading.Thread(target=self._take, name="bag-taker", daemon=True)
        self._seeker = threading.Thread(target=self._seek, name="bag-discovery", daemon=True)

    @property
    def topics(self) -> int:
        """Number of recorded topics."""
        return len(self._subscriptions)

    @property
    def is_paused(self) -> bool:
        """True if messages are dropped at the moment."""
        return self._paused

    def start(self) -> None:
        """Begin to look for topics and to take their messages."""
        if self._options.use_sim_time:
            self._logger.info("use_sim_time set, waiting for /clock before starting recording...")
            self._clock_start = self._node.get_clock().create_jump_callback(
                JumpThreshold(
                    min_forward=Duration(nanoseconds=1), min_backward=None, on_clock_change=False
                ),
                post_callback=self._say_that_the_clock_runs,
            )
        self._remove_listener = self._graph.add_listener(self._graph_changed.set)
        # The first look needs no change.
        self._graph_changed.set()
        self._seeker.start()
        self._taker.start()

    def _say_that_the_clock_runs(self, _jump: TimeJump) -> None:
        self._clock_start.unregister()
        self._logger.info("Sim time /clock found, starting recording.")

    def stop(self) -> None:
        """Stop recording; what has arrived is handed to the bag first."""
        self._stopped.set()
        self._graph_changed.set()
        self._wait_set.wake()
        self._seeker.join()
        self._taker.join()
        self._remove_listener()
        self._wait_set.close()
        with self._taking:
            self._take_all()
            for subscription in self._subscriptions.values():
                subscription.close()
            self._is_closed = True

    def pause(self) -> None:
        """Drop messages until :meth:`resume`."""
        with self._taking:
            if self._paused:
                return
            self._take_all()  # what came before is recorded
            self._paused = True
        self._logger.info("Pausing recording.")

    def resume(self) -> None:
        """Record again, with the latched messages that arrived during the pause."""
        with self._taking:
            if not self._paused:
                return
            self._take_all()  # what came before is not recorded
            self._paused = False
            if not self._is_waiting():
                self._write_latched(self._simulated_ns() or time.time_ns())
        self._logger.info("Resuming recording.")

    def toggle_paused(self) -> None:
        """Pause or resume."""
        (self.resume if self._paused else self.pause)()

    # -- topics

    def _seek(self) -> None:
        for topic, type_name in self._static.items():
            self._subscribe(topic, type_name, [])
        self._graph.wait_for(self._is_settled, _DISCOVERY_NS)
        self._subscribe_to_new()
        for text in missing(self._options, self._graph, self._subscriptions.keys()):
            self._logger.warning(text)
        while not self._stopped.is_set():
            # Before the look, so that no change is missed.
            self._graph_changed.clear()
            self._subscribe_to_new()
            if self._options.is_discovery_disabled:
                return
            if self._has_all_requested():
                self._logger.info("All requested topics are subscribed. Stopping discovery...")
                return
            self._graph_changed.wait()
            # Changes come in groups; looking at each would subscribe before all publishers are
            # known.
            self._stopped.wait(self._options.topic_polling_interval.total_seconds())

    def _is_settled(self) -> bool:
        return self._stopped.is_set() or self._graph.is_complete()

    def _has_all_requested(self) -> bool:
        options = self._options
        by_name_only = not (
            options.all_topics
            or options.all_services
            or options.all_actions
            or options.actions
            or options.regex
            or options.topic_types
        )
        wanted = {*options.topics, *options.services}
        return by_name_only and bool(wanted) and wanted == self._subscriptions.keys()

    def _subscribe_to_new(self) -> None:
        publishers: dict[str, list[EndpointInfo]] = {}
        heard: set[str] = set()
        for endpoint in self._graph.endpoints():
            if endpoint.kind == "publisher":
                publishers.setdefault(endpoint.topic, []).append(endpoint)
            # The recorder's own subscription is not a listener.
            elif endpoint.node is None or endpoint.node.name != self._node.get_name():
                heard.add(endpoint.topic)
        for topic, types in self._graph.topic_names_and_types().items():
            there = publishers.get(topic, [])
            if topic in self._subscriptions:
                self._look_at_new_publishers(topic, there)
            elif topic not in self._refused and self._filter.takes(
                topic, types, published=bool(there), heard=topic in heard
            ):
                self._subscribe(topic, types[0], there)

    def _look_at_new_publishers(self, topic: str, publishers: list[EndpointInfo]) -> None:
        for publisher in publishers:
            if publisher.gid not in self._known_publishers:
                self._known_publishers.add(publisher.gid)
                if why := misses(topic, self._requested[topic], publisher.qos):
                    self._logger.warning(why)

    def _subscribe(self, topic: str, type_name: str, publishers: list[EndpointInfo]) -> None:
        offered = [publisher.qos for publisher in publishers]
        qos = self._qos(topic, offered)
        # The publishers' hash first, because this installation may have another version of the
        # type.
        their_hash = next((each.type_hash for each in publishers if each.type_hash), "")
        our_hash = known_hash(type_name)
        type_id = TypeId(type_name, their_hash or our_hash)
        try:
            subscription = self._opened(topic, type_id, qos, offered)
        except (BagError, WireError) as error:
            self._refused.add(topic)
            self._logger.error(  # noqa: TRY400
                printable(f"Topic '{topic}' cannot be recorded: {error}")
            )
            return
        self._known_publishers.update(publisher.gid for publisher in publishers)
        self._requested[topic] = qos
        self._subscriptions[topic] = subscription
        self._repeat_if_latched(topic, qos)
        self._wait_set.attach(subscription)
        self._logger.info(f"Subscribed to topic '{topic}'")
        if not our_hash:
            self._logger.warning(
                f"The type {type_name} of topic '{topic}' is not installed: its messages are "
                f"recorded without a definition. {source_hint(type_name)}".rstrip(". ")
            )

    def _repeat_if_latched(self, topic: str, qos: QoS) -> None:
        """Have latched messages repeated in further files, if that is asked for."""
        by_name = self._options.repeat_transient_local_messages
        depth = by_name.get(topic, self._options.repeat_all_transient_local_depth)
        if depth and qos.durability == Durability.TRANSIENT_LOCAL:
            self._recording.repeat(topic, depth)
        elif topic in by_name:
            self._logger.warning(
                f"Topic '{topic}' is not transient local: its messages are not repeated"
            )

    def _opened(self, topic: str, type_id: TypeId, qos: QoS, offered: list[QoS]) -> Subscription:
        """Subscribe to a topic that is added to the bag, or neither."""
        subscription = self._node._rclpy_wire.create_subscription(topic, type_id, qos)
        try:
            self._recording.add_topic(
                topic, type_id.name, qos=offered, hash_of_type=type_id.type_hash
            )
        except BagError:
            subscription.close()
            raise
        return subscription

    def _qos(self, topic: str, offered: list[QoS]) -> QoS:
        """Return the QoS to subscribe with; warn of messages that are lost by it."""
        override = self._options.topic_qos_profile_overrides.get(topic)
        if override is None:
            qos, warnings = subscription_qos(topic, offered)
            for warning in warnings:
                get_logger("rosbag2_storage").warning(warning)
            return qos
        self._logger.info(f"Overriding subscription profile for {topic}")
        if why := refusal(override, offered):
            self._logger.warning(
                f"The QoS override for '{topic}' does not match a publisher; its messages are not "
                f"recorded. {why}"
            )
        return override.to_wire()

    def _complain(self, severity: str, text: str) -> None:
        logger = self._logger
        (logger.error if severity == "error" else logger.warning)(text)

    # -- messages

    def _take(self) -> None:
        while not self._stopped.is_set():
            self._take_from(self._wait_set.wait())

    def _take_all(self) -> None:
        """Take what has arrived; for the holder of the lock."""
        if not self._is_closed:
            for subscription in list(self._subscriptions.values()):
                for _ in range(_MOST_BATCHES):
                    if self._take_one(subscription) < _BATCH:
                        break

    def _take_from(self, subscriptions: Iterable[Entity]) -> None:
        for subscription in subscriptions:
            if isinstance(subscription, Subscription):
                with self._taking:
                    self._take_one(subscription)

    def _take_one(self, subscription: Subscription) -> int:
        """Take a batch of a topic; returns how many messages."""
        taken = subscription.take(_BATCH)
        for data, info in taken:
            received_ns = self._simulated_ns() or info.received_timestamp_ns
            self._keep(subscription.topic, data, received_ns, info.source_timestamp_ns)
        return len(taken)

    def _keep(self, topic: str, data: bytes, received_ns: int, sent_ns: int) -> None:
        if not self._is_waiting():
            self._write_latched(received_ns)
            self._recording.write(topic, data, received_ns, sent_ns)
        elif self._requested[topic].durability == Durability.TRANSIENT_LOCAL:
            self._latched.append((topic, data, sent_ns))

    def _write_latched(self, now_ns: int) -> None:
        for topic, data, sent_ns in self._latched:
            self._recording.write(topic, data, now_ns, sent_ns)
        self._latched.clear()

    def _is_waiting(self) -> bool:
        """Return True if it is paused, or no simulated time has arrived yet."""
        return self._paused or (self._options.use_sim_time and not self._simulated_ns())

    def _simulated_ns(self) -> int:
        return self._node.get_clock().now().nanoseconds if self._options.use_sim_time else 0
