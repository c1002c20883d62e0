"""How many participants of a domain this host has, by the UDP ports that they have bound.

Every DDS participant binds a port whose number follows from domain and participant index (DDSI-RTPS 9.6.1.1). So one can tell without
waiting whether discovery still owes an answer.
"""

from __future__ import annotations

import re

__all__ = ["participants_on_host"]

_BASE = 7400
_PER_DOMAIN = 250
_METATRAFFIC_UNICAST = 10
_PER_PARTICIPANT = 2
_MAX_INDEX = 119  # above it, ports belong to the next domain
_LOCAL_PORT = re.compile(r"^\s*\d+: [0-9A-F]+:([0-9A-F]{4}) ", re.MULTILINE)


def participants_on_host(domain_id: int) -> int | None:
    """The number of participants of the domain in this host's network namespace; None where the kernel does not tell (only Linux does)."""
    first = _BASE + _PER_DOMAIN * domain_id + _METATRAFFIC_UNICAST
    ports: set[int] = set()
    try:
        for table in ("/proc/net/udp", "/proc/net/udp6"):
            with open(table, encoding="ascii") as file:
                ports.update(int(port, 16) for port in _LOCAL_PORT.findall(file.read()))
    except OSError:
        return None
    return sum(first + _PER_PARTICIPANT * index in ports for index in range(_MAX_INDEX + 1))
