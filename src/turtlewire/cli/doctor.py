"""Says in plain words what is wrong with the setup and with the TF traffic, and what to do about it."""

from __future__ import annotations

import json
import os
import sys
from collections import Counter
from typing import TYPE_CHECKING, NamedTuple

from turtlewire.cli.network import domains_of, multicast_works, udp_ports
from turtlewire.cli.tf_traffic import TfListener, TfTraffic, tf_publishers
from turtlewire.errors import WireError
from turtlewire.printable import printable
from turtlewire.wire.environment import Range, discovery, domain_id
from turtlewire.wire.names import fully_qualified_node_name, is_hidden
from turtlewire.wire.qos import Durability, Reliability

if TYPE_CHECKING:
    from collections.abc import Iterable

    from turtlewire.wire.base import EndpointInfo, Graph

__all__ = [
    "Finding",
    "as_json",
    "examine",
    "graph_findings",
    "network_findings",
    "report",
    "setup_findings",
    "tf_findings",
]

_LISTEN_S = 2.0
_STALE_NS = 2_000_000_000
_ANSWER_NS = 500_000_000  # other hosts get as long as ROS 2's own tools give them
_WALL_TIME_FROM_NS = 1_000_000_000 * 1_000_000_000  # the year 2001; simulated time begins at zero


class Finding(NamedTuple):
    """One thing that is wrong, or strange.

    Attributes:
        is_problem: Whether it surely keeps something from working; else it is only worth knowing.
        text: What was found.
        remedy: What to do.
    """

    is_problem: bool
    text: str
    remedy: str


def examine(listen_s: float | None = None) -> list[Finding]:
    """Look at the setup, at the graph and at the transforms.

    Args:
        listen_s: How long to listen to the transforms; None listens for two seconds, and only until
            each publisher was heard when all of them are static.
    """
    from turtlewire.wire import open_context

    found = setup_findings(os.environ, sys.path) + network_findings()
    try:
        context = open_context()
    except WireError as error:
        return [*found, Finding(True, str(error), error.hint)]
    try:
        context.create_node("_turtlewire_doctor")
        listener = TfListener(context)
        if discovery().static_peers or not _only_this_host():
            context.graph.wait_for(lambda: False, _ANSWER_NS)
        context.graph.wait_for(context.graph.is_complete, 2_000_000_000)
        if listen_s is None:
            listener.gather(context.graph, _LISTEN_S)
        elif tf_publishers(context.graph):
            listener.wait(listen_s)
        traffic = listener.close()
        return [*found, *graph_findings(context.graph), *tf_findings(context.graph, traffic)]
    finally:
        context.close()


def report(findings: list[Finding]) -> str:
    """The findings as text, problems first."""
    if not findings:
        return "Nothing is wrong as far as can be seen."
    lines = []
    for finding in sorted(findings, key=lambda finding: not finding.is_problem):
        kind = "PROBLEM" if finding.is_problem else "note"
        lines.append(f"{kind}: {printable(finding.text)}")
        lines.append(f"    {printable(finding.remedy)}")
    return "\n".join(lines)


def as_json(findings: list[Finding]) -> str:
    """The findings as a JSON object in one line, problems first."""
    ordered = sorted(findings, key=lambda finding: not finding.is_problem)
    return json.dumps({"findings": [finding._asdict() for finding in ordered]})


def setup_findings(
    environment: dict[str, str] | os._Environ[str], path: Iterable[str]
) -> list[Finding]:
    """What is wrong with the installation and the environment variables."""
    from turtlewire.tf.buffer import CORE

    found = []
    if CORE == "python":
        remedy = "Install g++ and the Python headers (Debian: g++ python3-dev), then install turtlewire again."
        found.append(
            Finding(
                False, "The plain-Python core is in use; lookups take many times as long.", remedy
            )
        )
    distro = environment.get("ROS_DISTRO", "jazzy")
    if distro != "jazzy":
        remedy = "Use a shell in which no other ROS is sourced. From kilted on, turtlesim speaks the interfaces of turtlesim_msgs."
        found.append(
            Finding(
                False,
                f"ROS_DISTRO is '{distro}', but the names and texts here are those of jazzy.",
                remedy,
            )
        )
    homes = {
        os.path.realpath(folder)
        for folder in path
        if os.path.isfile(os.path.join(folder, "rclpy", "__init__.py"))
    }
    if len(homes) > 1:
        remedy = (
            "Leave out one of them: do not source a real ROS in a shell that uses turtlewire-ros."
        )
        found.append(
            Finding(
                True,
                f"Two ROS installations are mixed: rclpy is in {' and in '.join(sorted(homes))}.",
                remedy,
            )
        )
    return found


def network_findings() -> list[Finding]:
    """What keeps this computer from finding others; nothing when it does not look for them."""
    if _only_this_host() or multicast_works():
        return []
    remedy = "Allow UDP to 239.255.0.1 (firewall, VPN, container network), or name the other hosts: ROS_STATIC_PEERS='HOST1;HOST2'."
    return [
        Finding(
            True,
            "A multicast datagram does not come back: nodes on other hosts will not be found.",
            remedy,
        )
    ]


def _only_this_host() -> bool:
    return discovery().range in (Range.LOCALHOST, Range.OFF)


def graph_findings(graph: Graph) -> list[Finding]:
    """What is wrong among the nodes and topics."""
    names = [fully_qualified_node_name(node.name, node.namespace) for node in graph.nodes()]
    visible = [name for name in names if not is_hidden(name)]
    if not visible:
        return [_nobody()]
    found = []
    for name, count in sorted(Counter(visible).items()):
        if count > 1:
            remedy = "Rename all but one: --ros-args -r __node:=NAME"
            found.append(Finding(True, f"{count} nodes have the same name {name}.", remedy))
    topics: dict[str, list[EndpointInfo]] = {}
    for endpoint in graph.endpoints():
        if endpoint.topic.startswith("/"):
            topics.setdefault(endpoint.topic, []).append(endpoint)
    for topic, ends in sorted(topics.items()):
        found += _topic_findings(topic, ends)
    return found


def _nobody() -> Finding:
    chosen = discovery().range
    others = sorted(domains_of(udp_ports()) - {domain_id()})
    domain = os.environ.get("ROS_DOMAIN_ID") or "0"
    reach = "this host" if _only_this_host() else "this network"
    remedy = "Start one. "
    if others:
        remedy += f"This host has nodes on domain {', '.join(map(str, others))}: export ROS_DOMAIN_ID={others[0]} to see them. "
    remedy += f"Nodes that talk to each other need the same ROS_DOMAIN_ID (here {domain}); and for those on other hosts, "
    remedy += f"ROS_AUTOMATIC_DISCOVERY_RANGE=SUBNET on both sides (here {chosen.value})."
    return Finding(True, f"No node is seen on domain {domain} of {reach}.", remedy)


def _topic_findings(topic: str, ends: list[EndpointInfo]) -> list[Finding]:
    publishers = [end for end in ends if end.kind == "publisher"]
    subscriptions = [end for end in ends if end.kind == "subscription"]
    types = sorted({end.type_name for end in ends})
    if len(types) > 1:
        remedy = "Messages pass only between ends of one type: remap one of the topics."
        return [Finding(True, f"{topic} has ends of different types: {', '.join(types)}.", remedy)]
    found = []
    for publisher in publishers:
        for subscription in subscriptions:
            reason = _mismatch(publisher, subscription)
            if reason:
                text = f"{topic}: {_owner(subscription)} gets nothing from {_owner(publisher)}: {reason}."
                found.append(
                    Finding(
                        True,
                        text,
                        "Give both the same QoS profile, or the subscription the weaker one.",
                    )
                )
    return found


def _mismatch(publisher: EndpointInfo, subscription: EndpointInfo) -> str:
    """Why DDS does not connect the two; empty when it does."""
    if (
        publisher.qos.reliability == Reliability.BEST_EFFORT
        and subscription.qos.reliability == Reliability.RELIABLE
    ):
        return "it asks for RELIABLE, and BEST_EFFORT is offered"
    if (
        publisher.qos.durability == Durability.VOLATILE
        and subscription.qos.durability == Durability.TRANSIENT_LOCAL
    ):
        return "it asks for TRANSIENT_LOCAL, and VOLATILE is offered"
    if (
        publisher.type_hash
        and subscription.type_hash
        and publisher.type_hash != subscription.type_hash
    ):
        return "their definitions of the type differ"
    return ""


def _owner(endpoint: EndpointInfo) -> str:
    node = endpoint.node
    return (
        "an unknown node" if node is None else fully_qualified_node_name(node.name, node.namespace)
    )


def tf_findings(graph: Graph, traffic: TfTraffic) -> list[Finding]:
    """What is wrong with the transforms."""
    owners = {end.gid: _owner(end) for end in graph.endpoints()}
    if not tf_publishers(graph):
        return [
            Finding(
                False,
                "Nobody publishes transforms.",
                "Start a node with a TransformBroadcaster or a StaticTransformBroadcaster.",
            )
        ]
    found = []
    for child, publishers in sorted(traffic.publishers.items()):
        if len(publishers) > 1:
            who = " and ".join(sorted(owners.get(gid, "an unknown node") for gid in publishers))
            found.append(
                Finding(
                    True,
                    f"The frame '{child}' is published by {who}.",
                    "A frame must have one publisher: stop the others.",
                )
            )
    for child, parents in sorted(traffic.parents.items()):
        if len(parents) > 1:
            remedy = (
                "A frame has one parent at a time; lookups fail or jump. Rename one of the frames."
            )
            found.append(
                Finding(
                    True,
                    f"The frame '{child}' has several parents: {', '.join(sorted(parents))}.",
                    remedy,
                )
            )
    roots = sorted(
        {parent for parents in traffic.parents.values() for parent in parents}
        - traffic.parents.keys()
    )
    if len(roots) > 1:
        remedy = "No lookup between them is possible: publish a transform from one root to the other (static_transform_publisher)."
        found.append(
            Finding(
                True,
                f"The frames form {len(roots)} separate trees, with the roots {', '.join(roots)}.",
                remedy,
            )
        )
    return found + _time_findings(traffic)


def _time_findings(traffic: TfTraffic) -> list[Finding]:
    found = []
    on_wall_time = {
        child for child, stamp in traffic.newest_ns.items() if stamp >= _WALL_TIME_FROM_NS
    }
    on_simulated_time = traffic.newest_ns.keys() - on_wall_time
    if on_wall_time and on_simulated_time:
        text = f"Wall time and simulated time are mixed: {min(on_wall_time)} and {min(on_simulated_time)}."
        found.append(Finding(True, text, "Set use_sim_time to the same value for all nodes."))
    for child in sorted(on_wall_time):
        behind = traffic.ended_ns - traffic.newest_ns[child]
        if behind > _STALE_NS:
            text = f"The newest transform of '{child}' is {behind / 1e9:.1f} s old."
            found.append(
                Finding(
                    False,
                    text,
                    "Its publisher is slow, or the clocks of two hosts differ (chrony or NTP sets them).",
                )
            )
    return found + _jump_findings(traffic)


def _jump_findings(traffic: TfTraffic) -> list[Finding]:
    found = []
    for child, back_ns in sorted(traffic.back_ns.items()):
        text = f"The stamps of '{child}' jump back, by up to {back_ns / 1e9:.3f} s."
        remedy = "Two sources send it, a bag starts anew, or a clock was set: listeners drop such transforms, or clear their buffers."
        found.append(Finding(True, text, remedy))
    for child, leap_m in sorted(traffic.leaps_m.items()):
        text = f"The frame '{child}' leaps by up to {leap_m:.1f} m from one transform to the next."
        found.append(
            Finding(
                False,
                text,
                "Either it was set to another place, or two sources disagree about where it is.",
            )
        )
    return found
