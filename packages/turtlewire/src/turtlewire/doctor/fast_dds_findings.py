"""Findings about nodes on Fast DDS, seen from Cyclone DDS.

Participants that receive only over shared memory open no port, so they cannot be queried. But Fast
DDS names its segments in ``/dev/shm`` after the ports that it would open, and each domain has its
own ports.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING

from turtlewire.doctor.finding import Finding, note, problem
from turtlewire.wire.cyclone.ports import ports_of
from turtlewire.wire.names import fully_qualified_node_name
from turtlewire.wire.qos import Reliability
from turtlewire.wording import counted

if TYPE_CHECKING:
    from turtlewire.doctor.fast_dds_search import Participant
    from turtlewire.wire.base import EndpointInfo, Graph

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


_VENDOR = b"\x01\x0f"
_LARGE_TYPES = {"sensor_msgs/msg/Image", "sensor_msgs/msg/PointCloud2"}
#: The socket of a node on Fast DDS has the size that the system gives by default.
_DEFAULT_BUFFER = Path("/proc/sys/net/core/rmem_default")
#: With this size, 239 of 240 images of up to 8 MB arrived.
_ROOM = 4_194_304
_MORE_ROOM = (
    "Give the node the larger buffer of the profile in docs/compatibility.md, or let the "
    "subscription be reliable."
)
_TOGETHER = (
    "Topics work between them; docs/compatibility.md lists where services do not, and which nodes "
    "cannot be reached."
)
_WITHOUT_SERVER = (
    "Also unset it for the robot's nodes, or run both ends with RMW_IMPLEMENTATION=rmw_zenoh_cpp "
    "and a router."
)
_BY_UDP = "Start them without that variable, or with FASTDDS_BUILTIN_TRANSPORTS=DEFAULT."
_START_BY_UDP = (
    "In the shell that starts them: export FASTDDS_BUILTIN_TRANSPORTS=DEFAULT (or UDPv4). If an "
    "XML profile lists their transports, add one of the type UDPv4."
)
_UDP = "UDPv4"
_NAMED = 5


def fast_dds_environment(environment: Mapping[str, str], middleware: str) -> list[Finding]:
    """Report variables that keep nodes on Fast DDS out of reach of Cyclone DDS.

    Args:
        environment: The environment variables.
        middleware: The middleware in use.
    """
    if middleware != "rmw_cyclonedds_cpp":
        return []
    found = []
    if server := environment.get("ROS_DISCOVERY_SERVER", "").strip():
        text = (
            f"ROS_DISCOVERY_SERVER is {server!r}, but the middleware is Cyclone DDS: nodes that "
            "use a discovery server are not seen."
        )
        found.append(problem(text, _WITHOUT_SERVER))
    transports = environment.get("FASTDDS_BUILTIN_TRANSPORTS", "").strip()
    if transports.partition("?")[0] in {"LARGE_DATA", "SHM"}:
        text = (
            f"FASTDDS_BUILTIN_TRANSPORTS is {transports!r}: nodes on Fast DDS that are started "
            "with it exchange no messages with Cyclone DDS, unless their range is LOCALHOST."
        )
        found.append(note(text, _BY_UDP))
    return found


def fast_dds_findings(graph: Graph, topics: Mapping[str, Iterable[EndpointInfo]]) -> list[Finding]:
    """Report participants of several middlewares, and images that get lost between them."""
    found = []
    middlewares = graph.middlewares()
    if any("Cyclone" not in name for name in middlewares):
        counted = ", ".join(f"{count} on {name}" for name, count in sorted(middlewares.items()))
        found.append(note(f"The other participants of this domain: {counted}.", _TOGETHER))
    buffer = _default_buffer()
    for topic, endpoints in sorted(topics.items()):
        if buffer < _ROOM and _loses_images(endpoints):
            text = (
                f"{topic}: a best-effort subscription on Fast DDS loses large messages from this "
                f"computer's Cyclone DDS: the socket buffer holds {buffer:,} bytes by default."
            )
            found.append(note(text, _MORE_ROOM))
    return found


def out_of_reach(
    graph: Graph, participants: Sequence[Participant], sharing: Mapping[int, bool]
) -> list[Finding]:
    """Report participants on Fast DDS that do not receive over UDPv4, as Cyclone DDS sends.

    Args:
        graph: The graph; it knows the nodes of those that announce them over UDPv4.
        participants: The participants on Fast DDS that have announced themselves.
        sharing: The processes of this host that share memory, and whether they have a UDPv4 port.
    """
    nodes: dict[bytes, set[str]] = {}
    for endpoint in graph.endpoints():
        if endpoint.node is not None:
            name = fully_qualified_node_name(endpoint.node.name, endpoint.node.namespace)
            nodes.setdefault(endpoint.gid[:12], set()).add(name)
    found = [
        f"{_owner(each, nodes.get(each.prefix, ()), sharing)} ({' and '.join(each.transports)})"
        for each in participants
        if each.transports and _UDP not in each.transports
    ]
    # Ports that a profile sets may lie outside the domain's.
    answered = {each.process for each in participants if not each.address}
    found += [
        f"{_process(str(process), command_of(process))} (shared memory)"
        for process, has_port in sorted(sharing.items())
        if not has_port and str(process) not in answered
    ]
    if not found:
        return []
    if len(found) > _NAMED:
        found[_NAMED:] = [counted(len(found) - _NAMED, "other")]
    text = (
        "Topics of participants on Fast DDS stay silent, because they do not receive over UDPv4: "
        f"{', '.join(found)}."
    )
    return [problem(text, _START_BY_UDP)]


def _owner(participant: Participant, nodes: Iterable[str], sharing: Mapping[int, bool]) -> str:
    if names := ", ".join(sorted(nodes)):
        return names
    if not participant.process:
        return f"participant {participant.prefix.hex('.')}"
    if participant.address:
        return f"process {participant.process} on {participant.address}"
    # In a container, the number may be that of another process.
    is_known = participant.process in map(str, sharing)
    return _process(participant.process, command_of(participant.process) if is_known else "")


def _process(number: str, command: str) -> str:
    return f"process {number} {command!r}" if command else f"process {number}"


def _loses_images(endpoints: Iterable[EndpointInfo]) -> bool:
    large = [each for each in endpoints if each.type_name in _LARGE_TYPES]
    receives = any(
        each.kind == "subscription"
        and each.gid.startswith(_VENDOR)
        and each.qos.reliability == Reliability.BEST_EFFORT
        for each in large
    )
    sends = any(each.kind == "publisher" and not each.gid.startswith(_VENDOR) for each in large)
    return receives and sends


def _default_buffer() -> int:
    """Return the default size of a socket's receive buffer; large if the system does not say."""
    try:
        return int(_DEFAULT_BUFFER.read_text(encoding="ascii"))
    except (OSError, ValueError):
        return _ROOM
