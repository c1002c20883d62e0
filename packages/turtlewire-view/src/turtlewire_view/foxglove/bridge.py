"""The state that all clients share: topics, services, parameters, connections and time."""

from __future__ import annotations

from collections.abc import Callable
from struct import Struct
from typing import TYPE_CHECKING, Any, Protocol

from turtlewire.msg import type_hash
from turtlewire.wire.base import TypeId
from turtlewire.wire.qos import QoS, Reliability
from turtlewire_view.foxglove import protocol
from turtlewire_view.foxglove.caller import Caller
from turtlewire_view.foxglove.connections import (
    GraphConnections,
    GraphWatch,
    connections_of,
    difference,
)
from turtlewire_view.foxglove.offers import Offers
from turtlewire_view.foxglove.parameters import ParameterEvents, Parameters

if TYPE_CHECKING:
    from turtlewire.web.loop_calls import LoopCalls
    from turtlewire.wire.base import Context, MessageInfo, Node
    from turtlewire_view.foxglove.options import BridgeOptions
    from turtlewire_view.foxglove.outbox import Outbox

__all__ = ["Bridge", "ConnectedClient", "Log"]


class Log(Protocol):
    """A logger for the server's user: a ``logging.Logger``, or rclpy's."""

    def info(self, message: str, /) -> Any:
        """Log what happens."""
        ...

    def warning(self, message: str, /) -> Any:
        """Log what the user should know of."""
        ...


class ConnectedClient(Protocol):
    """A connected client, as the bridge sees it.

    Attributes:
        outbox: What it has yet to receive.
        wants_connections: Whether it follows the connections.
        follows_parameters: Whether it follows any parameter.
    """

    outbox: Outbox
    wants_connections: bool

    @property
    def follows_parameters(self) -> bool:
        """True if clients can subscribe to parameters."""
        ...

    def channels_gone(self, numbers: set[int]) -> None:
        """Forget channels that the bridge has closed."""
        ...

    def wants_parameter(self, name: str) -> bool:
        """Return True if it follows this parameter."""
        ...


class Bridge:
    """Tells all clients of changes, and holds what their requests use. For the loop's thread.

    Args:
        context: The participant.
        node: Whose endpoints are used.
        options: What is served.
        log: Where lines for the server's user go.
        find_share: Returns the share folder of a package.
        calls: Of the loop.
    """

    def __init__(
        self,
        context: Context,
        node: Node,
        options: BridgeOptions,
        log: Log,
        find_share: Callable[[str], str | None],
        *,
        calls: LoopCalls,
    ) -> None:
        self.node = node
        self.graph = context.graph
        self.options = options
        self.log = log
        self.find_share = find_share
        self.clients: set[ConnectedClient] = set()
        self._everybody: tuple[ConnectedClient, ...] = ()  # the same, for threads of the wire
        self._connections = GraphConnections({}, {}, {})
        self._time = _SimulatedTime(node, self._tell_time) if options.use_sim_time else None
        self.offers = Offers(node, options, self.now_ns, log.warning)
        self.watch = GraphWatch(self.graph, calls, self._refresh)
        self.caller = Caller(context, node, calls, self.watch)
        allowed = options.patterns("param_whitelist")
        self.parameters = Parameters(self.caller, allowed, lambda: self.offers.service_names)
        self._parameter_events = ParameterEvents(node, calls, allowed, self._tell_parameters)
        self._refresh()

    @property
    def capabilities(self) -> list[str]:
        """Capabilities offered to clients."""
        wanted = self.options.capabilities
        return [
            name
            for name in protocol.CAPABILITIES
            if name in wanted and (name != "time" or self._time is not None)
        ]

    def now_ns(self) -> int:
        """Return the simulation's time; 0 without one."""
        return 0 if self._time is None else self._time.now_ns

    def add(self, client: ConnectedClient) -> None:
        """Send a new client all channels and services, and all later changes."""
        self.clients.add(client)
        self._everybody = tuple(self.clients)
        if self.offers.channels:
            channels = [each.advertisement() for each in self.offers.channels.values()]
            client.outbox.send(protocol.text("advertise", channels=channels))
        if self.offers.services:
            services = [each.advertisement() for each in self.offers.services.values()]
            client.outbox.send(protocol.text("advertiseServices", services=services))
        if self.now_ns() and "time" in self.capabilities:
            client.outbox.set_time(protocol.time_data(self.now_ns()))

    def remove(self, client: ConnectedClient) -> None:
        """Stop sending updates to a client."""
        self.clients.discard(client)
        self._everybody = tuple(self.clients)

    def show_connections(self, client: ConnectedClient) -> None:
        """Send a client all connections, and all later changes."""
        update = difference(GraphConnections({}, {}, {}), self._connections)
        client.outbox.send(protocol.text("connectionGraphUpdate", **update))

    def follow_parameters(self) -> None:
        """Listen to changes of parameters as long as a client wants to learn of them."""
        wanted = any(client.follows_parameters for client in self.clients)
        self._parameter_events.listen(wanted)

    def close(self) -> None:
        """Leave the wire."""
        self.watch.close()
        self._parameter_events.listen(False)
        self.offers.close()
        self.caller.close()
        if self._time is not None:
            self._time.close()

    def _refresh(self) -> None:
        endpoints = self.graph.endpoints()
        change = self.offers.refresh(endpoints)
        self.caller.forget_all_but(self.offers.service_names)
        gone = set(change.get("unadvertise", ()))
        if gone:
            for client in self.clients:
                client.channels_gone(gone)
        fields = {
            "unadvertise": "channelIds",
            "unadvertiseServices": "serviceIds",
            "advertise": "channels",
            "advertiseServices": "services",
        }
        for op, items in change.items():
            frame = protocol.text(op, **{fields[op]: items})
            for client in self.clients:
                client.outbox.send(frame)
        self._tell_connections(connections_of(endpoints))

    def _tell_connections(self, now: GraphConnections) -> None:
        update = difference(self._connections, now)
        self._connections = now
        if any(update.values()):
            frame = protocol.text("connectionGraphUpdate", **update)
            for client in self.clients:
                if client.wants_connections:
                    client.outbox.send(frame)

    def _tell_parameters(self, parameters: list[dict[str, Any]]) -> None:
        for client in self.clients:
            wanted = [each for each in parameters if client.wants_parameter(each["name"])]
            if wanted:
                client.outbox.send(protocol.text("parameterValues", parameters=wanted))

    def _tell_time(self, time_ns: int) -> None:
        """Send a new time to the clients; runs on a thread of the middleware."""
        if "time" in self.options.capabilities:
            frame = protocol.time_data(time_ns)
            for client in self._everybody:
                client.outbox.set_time(frame)


_TYPE = "rosgraph_msgs/msg/Clock"
_CLOCK = Struct("<4xiI")  # encapsulation, seconds, nanoseconds


class _SimulatedTime:
    """Follows ``/clock``.

    Args:
        node: Whose subscription it is.
        on_time: Called with each new time [ns] on a thread of the wire.

    Attributes:
        now_ns: The newest time; 0 until one has come.
    """

    def __init__(self, node: Node, on_time: Callable[[int], None]) -> None:
        self.now_ns = 0
        self._on_time = on_time
        self._subscription = node.create_subscription(
            "/clock",
            TypeId(_TYPE, type_hash(_TYPE)),
            QoS(depth=1, reliability=Reliability.BEST_EFFORT),
            self._receive,
        )

    def close(self) -> None:
        """Stop following the clock."""
        self._subscription.close()

    def _receive(self, cdr: bytes, _info: MessageInfo) -> None:
        if len(cdr) >= _CLOCK.size:
            seconds, nanoseconds = _CLOCK.unpack_from(cdr)
            self.now_ns = max(0, seconds * 1_000_000_000 + nanoseconds)
            self._on_time(self.now_ns)
