"""Cyclone's configuration for a domain, made from what the environment says about discovery."""

from __future__ import annotations

import os
import re

from turtlewire.errors import WireError
from turtlewire.wire.environment import Discovery, Range

from .ports import max_processes

__all__ = ["domain_configuration"]

#: Receive buffers above Cyclone's 1 MB, as far as the system lets it: a message of some megabytes, or the heartbeats of a crowd, arrive in
#: one burst. (Heartbeats are left alone: rarer ones would calm a crowd that starts, and make `ros2 node list` beside it wait for seconds.)
_INTERNAL = '<Internal><SocketReceiveBufferSize max="10 MB"/></Internal>'
#: Cyclone 11 announces a participant to each address once, and then not for half a minute: one lost datagram in the crowd of a launch
#: would keep two processes apart for good.
_ANNOUNCEMENT_INTERVAL = "5s"
_ADDRESS = r"[A-Za-z0-9.:_%\[\]-]+"


def domain_configuration(domain_id: int, discovery: Discovery) -> str:
    """The configuration: ours first and then ``CYCLONEDDS_URI``, so that the user has the last word.

    Raises:
        WireError: A static peer is not an address.
    """
    parts = [_general(discovery), _INTERNAL]
    if discovery.range == Range.OFF:
        # A tag of our own: participants with different tags do not see each other, not even on this host.
        tag = f"<Tag>ros_discovery_off_{os.getpid()}</Tag>"
        parts.append(f"<Discovery><ParticipantIndex>none</ParticipantIndex>{tag}</Discovery>")
    else:
        # Cyclone takes indices below this number, and looks for others up to it
        limit = f"<MaxAutoParticipantIndex>{max_processes(domain_id)}</MaxAutoParticipantIndex>"
        index = f"<ParticipantIndex>auto</ParticipantIndex>{limit}"
        interval = f"<SPDPInterval>{_ANNOUNCEMENT_INTERVAL}</SPDPInterval>"
        parts.append(f"<Discovery>{index}{interval}{_peers(discovery)}</Discovery>")
    ours = f"<CycloneDDS><Domain>{''.join(parts)}</Domain></CycloneDDS>"
    users = os.environ.get("CYCLONEDDS_URI", "")
    return f"{ours},{users}" if users else ours


def _general(discovery: Discovery) -> str:
    if discovery.range in {Range.SUBNET, Range.SYSTEM_DEFAULT}:
        return ""
    # Without the loopback interface Cyclone 11 drops what processes with a configuration of rmw_cyclonedds send to localhost; and with
    # it alone, nobody from outside gets in.
    loopback = '<Interfaces><NetworkInterface address="127.0.0.1"/></Interfaces>'
    return f"<General><AllowMulticast>false</AllowMulticast>{'' if discovery.static_peers else loopback}</General>"


def _peers(discovery: Discovery) -> str:
    peers = []
    if discovery.range == Range.LOCALHOST:
        # Never given up, because with static peers it is we who must find the processes of this host (see _general).
        peers.append('<Peer address="localhost" PruneDelay="inf"/>' if discovery.static_peers else '<Peer address="localhost"/>')
    if discovery.range != Range.SYSTEM_DEFAULT:
        peers += [f'<Peer address="{_checked(address)}"/>' for address in discovery.static_peers]
    return f"<Peers>{''.join(peers)}</Peers>" if peers else ""


def _checked(address: str) -> str:
    if not re.fullmatch(_ADDRESS, address):
        error = WireError(f"ROS_STATIC_PEERS: {address!r} is not an address")
        raise error.with_hint("Write host names or IP addresses, separated by ';'.")
    return address
