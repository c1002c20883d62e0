"""Counts the processes of this host in a domain by the UDP ports that they have bound.

A DDS participant binds a port whose number follows from domain and participant index (DDSI-RTPS
9.6.1.1); Cyclone's participants of one process share a port. So the number of ports shows, without
waiting, if discovery has found all processes.
"""

from __future__ import annotations

import re
from contextlib import suppress

_BASE = 7400
_PER_DOMAIN = 250
_METATRAFFIC_UNICAST = 10
_PER_PARTICIPANT = 2
_MAX_PROCESSES = 120  # beyond, ports belong to the next domain
_LAST_PORT = 65535
_CYCLONE = b"\x01\x10"
_LOCAL_PORT = re.compile(r"^\s*\d+: [0-9A-F]+:([0-9A-F]{4}) ", re.MULTILINE)


def max_processes(domain_id: int) -> int:
    """Return the largest number of processes of one host in a domain, by its ports.

    The last domain has fewer than the others.
    """
    return min(_MAX_PROCESSES, (_LAST_PORT - _first_port(domain_id)) // _PER_PARTICIPANT)


def _first_port(domain_id: int) -> int:
    return _BASE + _PER_DOMAIN * domain_id + _METATRAFFIC_UNICAST


def ports_of(domain_id: int) -> range:
    """Return the UDP ports of a domain."""
    first = _BASE + _PER_DOMAIN * domain_id
    return range(first, first + _PER_DOMAIN)


def unicast_ports_of(domain_id: int) -> range:
    """Return the UDP ports of a domain of which each is one process's."""
    return range(_first_port(domain_id), ports_of(domain_id).stop)


def udp_ports() -> set[int] | None:
    """Return the UDP ports that are in use in this host's network namespace.

    None where the kernel does not tell (only Linux does).
    """
    ports: set[int] | None = None
    for table in ("/proc/net/udp", "/proc/net/udp6"):  # a kernel without IPv6 has only the first
        with suppress(OSError), open(table, encoding="ascii") as file:
            ports = {int(port, 16) for port in _LOCAL_PORT.findall(file.read())}.union(ports or ())
    return ports


def processes_on_host(domain_id: int) -> int | None:
    """Return the number of processes of the domain in this host's network namespace.

    None where the kernel does not tell.
    """
    first, ports = _first_port(domain_id), udp_ports()
    if ports is None:
        return None
    return sum(first + _PER_PARTICIPANT * index in ports for index in range(_MAX_PROCESSES))


def is_cyclone(gid: bytes) -> bool:
    """Return True if the gid is one of Cyclone's: it begins with the number of the vendor."""
    return gid.startswith(_CYCLONE)


def process_of(gid: bytes) -> bytes:
    """Return the part of a gid that participants of one process share.

    Other vendors than Cyclone have one port for each participant.
    """
    return gid[:4] if is_cyclone(gid) else gid[:12]
