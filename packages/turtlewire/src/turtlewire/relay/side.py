"""One end of a relay: its context, its nodes and the thread that takes messages.

All nodes of a relay are in a separate enclave. Relays carry no data from such nodes, so no message
loops. The enclave is announced with the participant, before any endpoint.
"""

from __future__ import annotations

import secrets
import threading
import time
import zlib
from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, NamedTuple

from turtlewire.errors import WireError
from turtlewire.wire import names, open_context
from turtlewire.wire.environment import MAX_DOMAIN_ID
from turtlewire.wire.report import warn_once

if TYPE_CHECKING:
    from turtlewire.wire.base import EndpointInfo, Entity, Node, NodeInfo, Waitable

_MIDDLEWARES = {"cyclonedds": "rmw_cyclonedds_cpp", "zenoh": "rmw_zenoh_cpp"}
_FAST_DDS = {"fastdds", "fastrtps", "rmw_fastrtps_cpp", "rmw_fastrtps_dynamic_cpp"}


class End(NamedTuple):
    """One of the two networks.

    Attributes:
        middleware: ``rmw_cyclonedds_cpp`` or ``rmw_zenoh_cpp``.
        domain_id: The domain.
    """

    middleware: str
    domain_id: int

    @property
    def is_zenoh(self) -> bool:
        """True if the middleware is Zenoh."""
        return self.middleware == _MIDDLEWARES["zenoh"]

    def __str__(self) -> str:
        return f"{'zenoh' if self.is_zenoh else 'cyclonedds'}:{self.domain_id}"


def parse_end(text: str) -> End:
    """Read ``cyclonedds:0`` or ``zenoh:7``.

    Raises:
        ValueError: The text names no network; the message shows the format.
    """
    name, _, domain = text.partition(":")
    if name in _FAST_DDS:
        raise ValueError(
            f"{text!r}: nodes on Fast DDS are reached with cyclonedds:{domain or 'DOMAIN'}, which "
            "carries between Cyclone DDS and Fast DDS as well"
        )
    middleware = _MIDDLEWARES.get(name, name)
    if middleware not in _MIDDLEWARES.values():
        raise ValueError(f"{text!r} is not cyclonedds:DOMAIN or zenoh:DOMAIN")
    if not (domain.isascii() and domain.isdigit() and int(domain) <= MAX_DOMAIN_ID):
        raise ValueError(
            f"{text!r}: expected a domain from 0 to {MAX_DOMAIN_ID} after the colon, as in {name}:0"
        )
    return End(middleware, int(domain))


_ENCLAVES = "/turtlewire_relay/"


def is_relayed(node: NodeInfo) -> bool:
    """Return True if the node belongs to a relay."""
    return node.enclave.startswith(_ENCLAVES)


class Mark:
    """The mark of one relay.

    The enclaves of relays that carry the same names differ only in the time of their start and a
    random part.

    Args:
        names: The options that determine which names are carried.
    """

    def __init__(self, names: Iterable[str]) -> None:
        digest = zlib.crc32("\n".join(names).encode())
        self._alike = f"{_ENCLAVES}r{digest:08x}_"
        self.enclave = f"{self._alike}{time.time_ns():016x}_{secrets.token_hex(4)}"

    def elder(self, near: Iterable[NodeInfo], far: Iterable[NodeInfo]) -> bool:
        """Return True if an older relay carries the same names between the same networks.

        Args:
            near: The nodes at one end.
            far: The nodes at the other end.
        """
        there = {node.enclave for node in far}
        return any(
            node.enclave.startswith(self._alike)
            and node.enclave < self.enclave
            and node.enclave in there
            for node in near
        )


#: An endpoint on DDS that no node claims for this long is not one of ROS.
_PATIENCE_S = 2.0
_NAME = "_turtlewire_relay"


class Seen(NamedTuple):
    """A snapshot of one end's graph.

    Attributes:
        nodes: All nodes.
        real: The endpoints that do not belong to a relay.
        relayed: The gids of those that do.
        until: When an endpoint that no node claims yet will count as real (monotonic seconds);
            None if there is no such endpoint.
    """

    nodes: list[NodeInfo]
    real: list[EndpointInfo]
    relayed: set[bytes]
    until: float | None


class Side:
    """One end of a relay.

    Attributes:
        end: The network.
        node: The relay's own node, which owns what has no other owner.
    """

    def __init__(self, end: End, mark: Mark) -> None:
        self.end = end
        self._context = open_context(end.domain_id, middleware=end.middleware, enclave=mark.enclave)
        self.graph = self._context.graph
        self.node = self._context.create_node(_NAME)
        self._nodes: dict[str, Node] = {}
        self._unclaimed: dict[bytes, float] = {}
        self._handlers: dict[Entity, Callable[[], None]] = {}
        self._wait_set = self._context.create_wait_set()
        self._closed = False
        self._thread = threading.Thread(target=self._serve, name=f"relay {end}")
        self._thread.start()

    # -- the graph

    def look(self) -> Seen:
        """Return what the graph shows now."""
        real: list[EndpointInfo] = []
        relayed: set[bytes] = set()
        now, unclaimed = time.monotonic(), {}
        for endpoint in self.graph.endpoints():
            if endpoint.node is None:
                since = unclaimed[endpoint.gid] = self._unclaimed.get(endpoint.gid, now)
                if now - since >= _PATIENCE_S:
                    real.append(endpoint)
            elif is_relayed(endpoint.node):
                relayed.add(endpoint.gid)
            else:
                real.append(endpoint)
        self._unclaimed = unclaimed
        ends = (since + _PATIENCE_S for since in unclaimed.values())
        until = min((end for end in ends if end > now), default=None)
        return Seen(self.graph.nodes(), real, relayed, until)

    # -- nodes that represent nodes of the other end

    def node_for(self, full_name: str, seen: Seen) -> Node:
        """Return the node that represents one of the other end.

        It is the relay's own node if a node of this name is here already, if it is hidden, or if
        ROS's rules do not allow the name.
        """
        there = {
            names.fully_qualified_node_name(node.name, node.namespace)
            for node in seen.nodes
            if not is_relayed(node)
        }
        if names.is_hidden(full_name) or (full_name in there and full_name not in self._nodes):
            return self.node
        if full_name not in self._nodes:
            namespace, _, name = full_name.rpartition("/")
            namespace = namespace or "/"
            if names.validate_node_name(name) or names.validate_namespace(namespace):
                return self.node
            self._nodes[full_name] = self._context.create_node(name, namespace)
        return self._nodes[full_name]

    def keep_nodes(self, used: set[Node]) -> None:
        """Close the representing nodes that own nothing any more."""
        for full_name, node in list(self._nodes.items()):
            if node not in used:
                del self._nodes[full_name]
                node.close()

    # -- messages

    def serve(self, entity: Waitable, handle: Callable[[], None]) -> None:
        """Call ``handle`` on this end's thread whenever the entity is ready, until it is closed."""
        self._handlers[entity] = handle
        self._wait_set.attach(entity)

    def forget(self, entity: Waitable) -> None:
        """Close an entity that was served."""
        self._handlers.pop(entity, None)
        entity.close()

    def _serve(self) -> None:
        while not self._closed:
            for entity in self._wait_set.wait():
                handle = self._handlers.get(entity)
                if handle is None:
                    continue
                try:
                    handle()
                except WireError as error:
                    self.warn(error)

    def warn(self, error: WireError) -> None:
        """Print an error of this end, once and on one line."""
        warn_once(f"relay {self.end} {error}", f"{self.end}: {error.in_one_line()}")

    def close(self) -> None:
        """Leave the network."""
        self._closed = True
        self._wait_set.wake()
        self._thread.join()
        self._context.close()
