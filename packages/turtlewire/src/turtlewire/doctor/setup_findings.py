"""Faults of the installation, the environment variables and the network."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING

from turtlewire.distro import Distro, current_distro
from turtlewire.doctor.finding import Finding, note, problem
from turtlewire.doctor.network import multicast_works
from turtlewire.wire.environment import (
    IN_THE_CLEAR,
    NO_CYCLONE,
    REMEDY,
    Range,
    asks_for_security,
    discovery,
    enforces_security,
    is_installed,
    misspelt_enable,
)
from turtlewire.wire.libddsc import find_libddsc

if TYPE_CHECKING:
    from turtlewire.wire.base import Graph

_PLAIN_CORE = "The plain-Python core is in use; lookups are many times slower."
_INSTALL_COMPILER = (
    "Install g++ and the Python headers (Debian: g++ python3-dev), then install turtlewire again."
)
_UNSET_CORE = "Unset TURTLEWIRE_CORE, which chooses it."
_OTHER_LIBRARY = "Set CYCLONEDDS_HOME to the prefix of another library, or unset it."
_NO_WHEEL = "You need not do anything: it reaches the same robots."
_INSTALL_LIBDDSC = (
    "For robots that run rmw_cyclonedds_cpp or rmw_fastrtps_cpp, install a libddsc (Debian 13: apt "
    "install libddsc0t64)."
)
_BLIND = "Nodes of this computer that run on Fast DDS (rmw_fastrtps_cpp) are not found."
_OWN_ADDRESS = (
    "Cyclone DDS 0.10 finds them only at an address other than loopback. To allow this, which also "
    "admits the network: export ROS_STATIC_PEERS=ADDRESS, with an address of this computer."
)
_OTHER_DISTRO = (
    "Use a shell in which no other ROS is sourced, or choose one with ROS_DISTRO=jazzy, kilted or "
    "lyrical."
)
_MIXED = "Leave out one of them: do not source a real ROS in a shell that uses turtlewire-ros."
_NO_MULTICAST = "A multicast datagram does not come back: nodes on other hosts will not be found."
_ALLOW_MULTICAST = (
    "Allow UDP to 239.255.0.1 (firewall, VPN, container network), or name the other hosts: "
    "ROS_STATIC_PEERS='HOST1;HOST2'."
)


def setup_findings(environment: Mapping[str, str], path: Iterable[str]) -> list[Finding]:
    """Faults of the installation.

    Args:
        environment: The environment variables.
        path: The folders that Python imports from.
    """
    from turtlewire.tf.buffer import CORE

    remedy = _UNSET_CORE if environment.get("TURTLEWIRE_CORE") == "python" else _INSTALL_COMPILER
    found = [note(_PLAIN_CORE, remedy)] if CORE == "python" else []
    distro = environment.get("ROS_DISTRO", "")
    if distro not in {"", *map(str, Distro)}:
        used = current_distro(environment)
        text = f"ROS_DISTRO is '{distro}', but turtlewire uses the names and texts of {used}."
        found.append(note(text, _OTHER_DISTRO))
    found += _library_findings(asked=environment.get("RMW_IMPLEMENTATION", "").strip())
    found += _security_findings(environment)
    homes = {
        os.path.realpath(folder)
        for folder in path
        if os.path.isfile(os.path.join(folder, "rclpy", "__init__.py"))
    }
    if len(homes) > 1:
        places = " and in ".join(sorted(homes))
        found.append(problem(f"Two ROS installations are mixed: rclpy is in {places}.", _MIXED))
    return found


def _security_findings(environment: Mapping[str, str]) -> list[Finding]:
    """Report settings of SROS 2 that have no effect, or that keep everything from starting."""
    if value := misspelt_enable(environment):
        text = f"ROS_SECURITY_ENABLE is {value!r}, which ROS 2 treats as off."
        return [note(text, "ROS 2 compares it with 'true'. turtlewire does not support SROS 2.")]
    if asks_for_security(environment) and not enforces_security(environment):
        return [problem(f"{IN_THE_CLEAR}.", REMEDY)]
    return []


def _library_findings(asked: str) -> list[Finding]:
    """Return findings if an unusual libddsc is used, or none and no middleware was asked for."""
    library, refused = find_libddsc()
    found = [note(f"{sentence}.", _OTHER_LIBRARY) for sentence in refused]
    if library is None and not refused and not asked and is_installed("rmw_zenoh_cpp"):
        found.append(note(f"{NO_CYCLONE}.", _INSTALL_LIBDDSC))
    if library is not None and library.origin != "the cyclonedds wheel":
        found.append(note(f"{library} is in use: {library.reason}.", _NO_WHEEL))
    finds_fast_dds = library is None or library.abi is None or library.abi.finds_fast_dds
    if not finds_fast_dds and discovery().range == Range.LOCALHOST and not discovery().static_peers:
        found.append(note(_BLIND, _OWN_ADDRESS))
    return found


def network_findings() -> list[Finding]:
    """Faults that keep this host from finding others; none if it does not look for them."""
    if only_this_host() or multicast_works():
        return []
    return [problem(_NO_MULTICAST, _ALLOW_MULTICAST)]


def only_this_host() -> bool:
    """Return True if discovery stays on this host."""
    return discovery().range in (Range.LOCALHOST, Range.OFF)


def looks_for_others() -> bool:
    """Return True if this process looks for nodes on other hosts."""
    return bool(discovery().asked_peers) or not only_this_host()


_DISCOVERY_LIMIT_NS = 2_000_000_000
_OTHER_HOSTS_NS = 500_000_000  # as long as ROS 2's own tools wait for other hosts


def wait_for_graph(graph: Graph) -> None:
    """Wait until all nodes of this host are known, and for a moment for nodes of other hosts.

    It returns after at most 2.5 seconds, even if something on this host keeps silent.
    """
    graph.hurry()
    if looks_for_others():
        graph.wait_for(lambda: False, _OTHER_HOSTS_NS)
    graph.wait_for(graph.is_complete, _DISCOVERY_LIMIT_NS)
