"""The doctor's checks below the middleware: sockets of other domains, and multicast."""

from __future__ import annotations

import socket

from turtlewire.wire.cyclone import ports

#: The ports of the domains above it are among those that systems assign to any program.
_LAST_SURE_DOMAIN = 101

#: The multicast group that DDS participants announce themselves to.
GROUP = "239.255.0.1"


def udp_ports() -> set[int]:
    """Return the UDP ports that are in use on this host; empty on systems that do not tell."""
    return ports.udp_ports() or set()


def domains_of(used: set[int]) -> set[int]:
    """Return the ROS domains that UDP ports belong to."""
    domains = range(_LAST_SURE_DOMAIN + 1)
    return {each for each in domains if not used.isdisjoint(ports.unicast_ports_of(each))}


def other_domains(domain: int) -> list[int]:
    """Return the domains, other than this one, in which this computer has nodes."""
    return sorted(domains_of(udp_ports()) - {domain})


def named_domains(domains: list[int]) -> str:
    """Return the domains in words, such as ``domain 0`` or ``domains 0, 7 and 51``."""
    *first, last = map(str, domains)
    return f"domains {', '.join(first)} and {last}" if first else f"domain {last}"


def other_domains_hint(domain: int) -> str:
    """Say how to reach this computer's nodes on other domains; empty if no other domains exist."""
    others = other_domains(domain)
    if not others:
        return ""
    return (
        f"This computer has nodes on {named_domains(others)}: to reach them, end this program and "
        f"type: export ROS_DOMAIN_ID={others[0]}"
    )


def multicast_works(limit_s: float = 1.0) -> bool:
    """Return True if a datagram to the group of DDS comes back to a socket of this host."""
    with (
        socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as receiver,
        socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sender,
    ):
        try:
            receiver.bind(("", 0))
            receiver.setsockopt(
                socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP, socket.inet_aton(GROUP) + bytes(4)
            )
            receiver.settimeout(limit_s)
            sender.sendto(b"turtlewire doctor", (GROUP, receiver.getsockname()[1]))
            return receiver.recv(64) == b"turtlewire doctor"
        except OSError:  # no route, not permitted, or nothing came
            return False
