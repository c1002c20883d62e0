"""The doctor's checks below the middleware: sockets of other domains, and multicast."""

from __future__ import annotations

import re
import socket
from collections.abc import Iterable
from pathlib import Path

# How DDS computes its ports: a domain has 250, of which participants take those from the tenth on.
_FIRST_PORT, _PORTS_OF_DOMAIN, _FIRST_OF_PARTICIPANTS = 7400, 250, 10
#: The ports of the domains above it are among those that systems assign to any program.
_LAST_SURE_DOMAIN = 101

#: The multicast group that DDS participants announce themselves to.
GROUP = "239.255.0.1"


def udp_ports() -> set[int]:
    """Return the UDP ports that are in use on this host; empty on systems that do not tell."""
    ports: set[int] = set()
    for table in ("/proc/net/udp", "/proc/net/udp6"):
        try:
            text = Path(table).read_text(encoding="ascii")
        except OSError:
            continue
        ports |= {
            int(port, 16)
            for port in re.findall(r"^\s*\d+: [0-9A-F]+:([0-9A-F]{4}) ", text, re.MULTILINE)
        }
    return ports


def domains_of(ports: Iterable[int]) -> set[int]:
    """Return the ROS domains that UDP ports belong to."""
    found = set()
    for port in ports:
        domain, offset = divmod(port - _FIRST_PORT, _PORTS_OF_DOMAIN)
        if 0 <= domain <= _LAST_SURE_DOMAIN and offset >= _FIRST_OF_PARTICIPANTS:
            found.add(domain)
    return found


def other_domains(domain: int) -> list[int]:
    """Return the domains, other than this one, in which this computer has nodes."""
    return sorted(domains_of(udp_ports()) - {domain})


def named_domains(domains: list[int]) -> str:
    """Return the domains in words, such as ``domain 0`` or ``domains 0 and 51``."""
    return f"domain{'s' * (len(domains) > 1)} {' and '.join(map(str, domains))}"


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
