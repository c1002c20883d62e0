"""Finds conflicts in the graph, and the reasons why two endpoints do not connect.

Conflicts are two types on one topic or service, and two nodes with one name. A publisher and a
subscription connect if the publisher offers at least what the subscription requests. Both must
also use the same type.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from typing import TYPE_CHECKING, NamedTuple

from . import names
from .environment import compares_qos
from .qos import INFINITE_NS, Durability, Liveliness, Reliability
from .report import warn_once

if TYPE_CHECKING:
    from .base import EndpointInfo
    from .qos import QoS

#: The kind of endpoints whose types are compared with a new endpoint's. A server is not compared:
#: its clients have to use its type.
_OTHER = {"publisher": "subscription", "subscription": "publisher", "client": "service"}
_NO_MESSAGES = ": no messages get through. Use the topic's type, or another topic name."
_NO_REQUESTS = ": no requests get through. Use the service's type, or another service name."
_TEXTS = {
    "publisher": "topic {name} has the type {theirs}, but this process publishes {ours}"
    + _NO_MESSAGES,
    "subscription": "topic {name} has the type {theirs}, but this process subscribes to {ours}"
    + _NO_MESSAGES,
    "client": "service {name} has the type {theirs}, but this process calls {ours}" + _NO_REQUESTS,
}
#: The packages of turtlesim's interfaces in Jazzy, and in later distributions.
_TURTLESIMS = {"turtlesim", "turtlesim_msgs"}
_OTHER_DISTRIBUTION = (
    " The two packages belong to different distributions of ROS 2. Type export ROS_DISTRO=lyrical "
    "in both terminals; then both names mean the same types."
)
_OF_REQUESTS = {"publisher": "client", "subscription": "service"}


class EndpointTypes:
    """Warns once of a topic or service where this process and a peer use different types.

    The middleware matches endpoints by name and type, so such a pair is silent.
    """

    def __init__(self) -> None:
        self._all: dict[str, Counter[tuple[str, str]]] = {}
        self._own: dict[str, Counter[tuple[str, str]]] = {}

    def add(self, name: str, kind: str, type_name: str, *, own: bool) -> None:
        """Count an endpoint.

        Args:
            name: The full name of its topic or service.
            kind: ``publisher``, ``subscription``, ``client`` or ``service``.
            type_name: Its type, for example ``std_srvs/srv/Trigger``.
            own: Whether it is in this process.
        """
        known = self._all.setdefault(name, Counter())
        known[kind, type_name] += 1
        if own:
            self._own.setdefault(name, Counter())[kind, type_name] += 1
        if len(known) > 1 and name in self._own:
            self._compare(name)

    def _compare(self, name: str) -> None:
        for kind, type_name in self._own[name]:
            other = _OTHER.get(kind)
            others = {theirs for kind_, theirs in self._all[name] if kind_ == other}
            if others and type_name not in others and not _is_of_action(name, kind):
                warn_of_types(name, kind, type_name, others)

    def remove(self, name: str, kind: str, type_name: str, *, own: bool) -> None:
        """Undo :meth:`add`."""
        for counters in (self._all, self._own) if own else (self._all,):
            counter = counters[name]
            counter[kind, type_name] -= 1
            if not counter[kind, type_name]:
                del counter[kind, type_name]
            if not counter:
                del counters[name]


def warn_of_types(name: str, kind: str, ours: str, others: set[str]) -> None:
    """Warn once of a topic or service where this process uses another type than its peers.

    Args:
        name: The full name of the topic or service.
        kind: The kind of our endpoint: ``publisher``, ``subscription`` or ``client``.
        ours: Its type.
        others: The types of the peers.
    """
    theirs = " and ".join(sorted(others))
    text = _TEXTS[kind].format(name=name, theirs=theirs, ours=ours)
    if {each.partition("/")[0] for each in (ours, *others)} == _TURTLESIMS:
        text += _OTHER_DISTRIBUTION
    warn_once(f"types {name} {kind}", text)


def _is_of_action(name: str, kind: str) -> bool:
    """Return True for a client of an action, whose feedback subscription is compared."""
    return kind == "client" and "/_action/" in name


def as_compared(dds_topic: str, kind: str, type_name: str) -> tuple[str, str, str] | None:
    """Return the name, kind and type under which :class:`EndpointTypes` counts an endpoint.

    None for the replies of a service, because its requests are counted, and for topics that are
    not of ROS.
    """
    topic = names.topic_from_dds(dds_topic)
    if topic is not None:
        return topic, kind, type_name
    service = names.service_of_requests(dds_topic)
    if service is None:
        return None
    return service, _OF_REQUESTS[kind], names.service_type(type_name)


class NodeNames:
    """Warns once of each node of this process whose name another process also uses.

    Args:
        domain_id: The domain that both are in.
    """

    def __init__(self, domain_id: int) -> None:
        self._domain_id = domain_id
        self._others: dict[bytes, frozenset[str]] = {}

    def others(self, participant: bytes, nodes: Iterable[str], own: Iterable[str]) -> None:
        """Take over the full names of another participant's nodes, and compare them with ours."""
        self._others[participant] = frozenset(nodes)
        for name in self._others[participant].intersection(own):
            self._warn(name)

    def gone(self, participant: bytes) -> None:
        """Forget a participant that has left."""
        self._others.pop(participant, None)

    def own(self, name: str) -> None:
        """Compare the full name of a new node of ours."""
        if any(name in nodes for nodes in self._others.values()):
            self._warn(name)

    def _warn(self, name: str) -> None:
        if name.rpartition("/")[2].startswith("_"):
            return  # tools leave it out, and it offers nothing
        warn_once(
            f"node {name}",
            f"another process runs a node named {name} in domain {self._domain_id}: both receive "
            "what is sent to either. Run one of them in another domain (ROS_DOMAIN_ID=7), or under "
            "another name (--ros-args -r __node:=NAME). A process that was killed counts for 10 s.",
        )


class Obstacle(NamedTuple):
    """A reason why two endpoints are not connected.

    Attributes:
        policy: The QoS policy, for example ``reliability``, or ``type``.
        reason: The reason in words; "it" is the subscription.
    """

    policy: str
    reason: str


def obstacles(publisher: EndpointInfo, subscription: EndpointInfo) -> list[Obstacle]:
    """Return all reasons why the middleware does not connect two endpoints; empty if it does."""
    found = _obstacles_of_qos(publisher.qos, subscription.qos) if compares_qos() else []
    if publisher.type_name != subscription.type_name:
        text = f"its type is {subscription.type_name}, but the publisher's {publisher.type_name}"
        found.append(Obstacle("type", text))
    elif len({publisher.type_hash, subscription.type_hash} - {""}) > 1:
        found.append(Obstacle("type", "their definitions of the type differ"))
    return found


def _obstacles_of_qos(offered: QoS, requested: QoS) -> list[Obstacle]:
    found = []
    if (offered.reliability, requested.reliability) == (
        Reliability.BEST_EFFORT,
        Reliability.RELIABLE,
    ):
        found.append(_words("reliability", "RELIABLE", "BEST_EFFORT"))
    if (offered.durability, requested.durability) == (
        Durability.VOLATILE,
        Durability.TRANSIENT_LOCAL,
    ):
        found.append(_words("durability", "TRANSIENT_LOCAL", "VOLATILE"))
    if _limit(requested.deadline_ns) < _limit(offered.deadline_ns):
        words = map(_seconds, (requested.deadline_ns, offered.deadline_ns))
        found.append(_words("deadline", *(f"a deadline {word}" for word in words)))
    if (
        requested.liveliness == Liveliness.MANUAL_BY_TOPIC
        and offered.liveliness != Liveliness.MANUAL_BY_TOPIC
    ):
        found.append(_words("liveliness", "MANUAL_BY_TOPIC", "AUTOMATIC"))
    if _limit(requested.liveliness_lease_ns) < _limit(offered.liveliness_lease_ns):
        words = map(_seconds, (requested.liveliness_lease_ns, offered.liveliness_lease_ns))
        found.append(_words("liveliness", *(f"a liveliness lease {word}" for word in words)))
    return found


def _words(policy: str, requested: str, offered: str) -> Obstacle:
    return Obstacle(policy, f"it requests {requested}, but the publisher offers {offered}")


def _limit(duration_ns: int) -> int:
    return duration_ns or INFINITE_NS


def _seconds(duration_ns: int) -> str:
    limit = _limit(duration_ns)
    return "without limit" if limit >= INFINITE_NS else f"of {limit / 1e9:g} s"
