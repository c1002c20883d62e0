"""Cyclone's configuration for a domain, from the environment variables of discovery."""

from __future__ import annotations

import os

from turtlewire.wire.environment import Discovery, Range, lingers, split_peer
from turtlewire.wire.report import warn_once

from . import library as dds
from .ports import max_processes

#: Receive buffers above Cyclone's 1 MB, as far as the system lets it: a message of some megabytes,
#: or the heartbeats of a crowd, arrive in one burst. (Heartbeats are not changed: rarer ones would
#: calm a crowd that starts, and make `ros2 node list` beside it wait for seconds.)
_BUFFER = '<SocketReceiveBufferSize max="10 MB"/>'
#: Fast DDS takes notice of the end of an endpoint only when its key comes in this form. Without it,
#: it keeps the endpoint until the participant leaves, and one that is killed leaves after 10 s.
_KEYHASH = "<GenerateKeyhash>true</GenerateKeyhash>"
_NO_LINGER = "<WriterLingerDuration>0 s</WriterLingerDuration>"
#: Cyclone 11 announces a participant to each address once, and then not for half a minute: one lost
#: datagram in the crowd of a launch would keep two processes apart permanently.
_ANNOUNCEMENT_INTERVAL = "5s"
#: Loopback carries datagrams of 64 KB whole: an image of 6 MB takes 95 of them instead of the 423
#: of Cyclone's default, and more than twice as many images get through. Every DDS reads them.
#: Networks would split them and lose all of one when a piece gets lost: they keep the default.
#: Each holds one fragment. With Cyclone's fragments of 1.3 kB, a reader asks for the 48 of a lost
#: datagram in several rounds, which held up one flood of images in four for more than a second.
_LOOPBACK_DATAGRAM = "<MaxMessageSize>65500B</MaxMessageSize><FragmentSize>64000B</FragmentSize>"
#: Fast DDS 3 describes the types of its endpoints. Cyclone asks for the details, cannot read some
#: answers ("invalid type object"), and from then on drops every endpoint with such a type: replies
#: to a client would reach nobody. Our types match by name, as those of rmw_cyclonedds.
_TYPES_OF_FAST_DDS = (
    "<Compatibility><IgnoreTypeInformation>1.15</IgnoreTypeInformation></Compatibility>"
)
_FOR_EVER = ' PruneDelay="inf"'


def domain_configuration(domain_id: int, discovery: Discovery) -> str:
    """Return the configuration.

    Ours first and then ``CYCLONEDDS_URI``, so that the user has the last word.

    Raises:
        WireError: A static peer is not an address.
    """
    internal = _BUFFER + _KEYHASH + ("" if lingers() else _NO_LINGER)
    parts = [_general(discovery), f"<Internal>{internal}</Internal>"]
    if dds.ABI.ignores_types:
        parts.append(_TYPES_OF_FAST_DDS)
    if discovery.range == Range.OFF:
        # A tag of our own: participants with different tags do not see each other, not even on this
        # host.
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


def stays_on_loopback(discovery: Discovery) -> bool:
    """Return True if the loopback interface is the only one that the configuration uses."""
    is_wide = discovery.range in {Range.SUBNET, Range.SYSTEM_DEFAULT}
    return not is_wide and not discovery.asked_peers


def _general(discovery: Discovery) -> str:
    if discovery.range in {Range.SUBNET, Range.SYSTEM_DEFAULT}:
        return ""
    # Without the loopback interface Cyclone 11 drops what processes with a configuration of
    # rmw_cyclonedds send to localhost; and with it alone, nothing is sent to another host.
    loopback = '<Interfaces><NetworkInterface address="127.0.0.1"/></Interfaces>'
    interfaces = loopback + _LOOPBACK_DATAGRAM if stays_on_loopback(discovery) else ""
    return f"<General><AllowMulticast>false</AllowMulticast>{interfaces}</General>"


def _peers(discovery: Discovery) -> str:
    peers = []
    if discovery.range == Range.LOCALHOST:
        # With static peers it is never given up, because then we must find the processes of this
        # host (see _general). Not "localhost": Cyclone aborts where nothing resolves that name.
        for_ever = discovery.asked_peers and dds.ABI.prunes_peers
        peers.append(f'<Peer address="127.0.0.1"{_FOR_EVER if for_ever else ""}/>')
    peers += [
        f'<Peer address="{address}"/>'
        for address in map(_resolved, discovery.asked_peers)
        if address
    ]
    return f"<Peers>{''.join(peers)}</Peers>" if peers else ""


def _resolved(peer: str) -> str:
    """Return the IPv4 address of a static peer, and its port if it has one.

    Empty, after a warning, when there is no such host.

    Cyclone aborts the process for a peer that it cannot resolve, so it gets none.

    Raises:
        WireError: ``peer`` does not have the form of an address.
    """
    import socket

    host, port = split_peer(peer)
    try:
        address = socket.getaddrinfo(host, None, socket.AF_INET)[0][4][0]
    except (OSError, UnicodeError) as error:
        warn_once(
            f"static peer {peer}",
            f"ROS_STATIC_PEERS: {peer} is ignored, it has no IPv4 address: {error.args[-1]}",
        )
        return ""
    if address == "0.0.0.0":  # noqa: S104 - nothing is bound to it
        warn_once(
            f"static peer {peer}",
            f"ROS_STATIC_PEERS: {peer} is ignored: it is not the address of a computer",
        )
        return ""
    return f"{address}:{port}" if port else str(address)
