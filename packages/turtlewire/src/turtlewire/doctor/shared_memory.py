"""Processes of this host whose participants on Fast DDS receive over shared memory.

Participants that receive only over shared memory open no port, so they cannot be queried. But Fast
DDS names its segments in ``/dev/shm`` after the ports that it would open, and each domain has its
own ports.
"""

from __future__ import annotations

import re
from contextlib import suppress
from pathlib import Path

from turtlewire.wire.cyclone.ports import ports_of

__all__ = ["command_of", "sharing_processes"]

_SEGMENTS = Path("/dev/shm")  # noqa: S108 - nothing is written there
_PROCESSES = Path("/proc")
_SEGMENT = re.compile(r"/fast(?:rtps|dds)_port(\d+)")
_SOCKET = re.compile(r"socket:\[(\d+)\]")
_LONGEST_COMMAND = 60


def sharing_processes(domain_id: int) -> dict[int, bool]:
    """Return the processes that share memory in a domain, and whether they have a UDPv4 port of it.

    Empty on systems without ``/proc``; processes of other users are not seen.
    """
    ports = ports_of(domain_id)
    if not any(_names_port(str(segment), ports) for segment in _SEGMENTS.glob("fast*_port*")):
        return {}
    found = {}
    for process in _PROCESSES.glob("[0-9]*"):
        with suppress(OSError):  # it has ended, or is another user's
            maps = (process / "maps").read_text("utf-8", "replace")
            if _names_port(maps, ports):
                found[int(process.name)] = _has_udp_port(process, ports)
    return found


def _names_port(text: str, ports: range) -> bool:
    return any(int(port) in ports for port in _SEGMENT.findall(text))


def _has_udp_port(process: Path, ports: range) -> bool:
    sockets = set()
    for file in (process / "fd").iterdir():
        with suppress(OSError):  # already closed
            sockets.update(_SOCKET.findall(str(file.readlink())))
    rows = (process / "net" / "udp").read_text("ascii").splitlines()[1:]
    columns = [row.split() for row in rows]
    return any(row[9] in sockets and int(row[1].partition(":")[2], 16) in ports for row in columns)


def command_of(process: int | str) -> str:
    """Return the command line of a process, shortened; empty if it is not known."""
    try:
        words = (_PROCESSES / str(process) / "cmdline").read_bytes().split(b"\x00")
    except (OSError, ValueError):
        return ""
    line = b" ".join(words).decode("utf-8", "replace").strip()
    return line if len(line) <= _LONGEST_COMMAND else f"{line[: _LONGEST_COMMAND - 3]}..."
