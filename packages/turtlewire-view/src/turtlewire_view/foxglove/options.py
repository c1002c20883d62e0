"""Options of a server: the topics to serve, the address, the allowed clients."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass

from turtlewire_view.foxglove.protocol import CAPABILITIES

__all__ = ["ASSETS", "DEFAULT_PORT", "BridgeOptions", "Patterns"]

#: Where Foxglove and Lichtblick look for a server.
DEFAULT_PORT = 8765
#: Which files clients may read: pictures, meshes and descriptions of packages.
ASSETS = (
    r"^package://(?:[-\w%]+/)*[-\w%.]+"
    r"\.(?:dae|fbx|glb|gltf|jpeg|jpg|mtl|obj|png|stl|tif|tiff|urdf|webp|xacro)$"
)


class Patterns:
    """Regular expressions, one of which must match a whole name; letters of any case are the same.

    Args:
        patterns: The expressions.
        what: What they are, for the error.

    Raises:
        ValueError: A pattern is not a regular expression.
    """

    def __init__(self, patterns: Iterable[str], what: str = "pattern") -> None:
        self._compiled = [_compiled(pattern, what) for pattern in patterns]

    def match(self, name: str) -> bool:
        """Return True if one of the expressions matches the whole name."""
        return any(pattern.fullmatch(name) for pattern in self._compiled)


def _compiled(pattern: str, what: str) -> re.Pattern[str]:
    try:
        return re.compile(pattern, re.IGNORECASE)
    except re.error as error:
        raise ValueError(f"{what} {pattern!r} is not a regular expression: {error}") from error


_ALL = (".*",)


@dataclass(frozen=True)
class BridgeOptions:
    """The settings of a server; names and defaults follow ROS 2's foxglove_bridge.

    The exception is `address`, which is 0.0.0.0 there.

    Attributes:
        port: TCP port; 0 takes a free one.
        address: Where it listens. Anyone who can reach an address other than loopback can
            read all topics, and publish.
        topic_whitelist: Regular expressions of the topics that are offered.
        service_whitelist: Regular expressions of the services that are offered.
        param_whitelist: Regular expressions of the parameters, ``/node.name``.
        client_topic_whitelist: Regular expressions of topics that clients may publish on.
        include_hidden: Whether topics and services are offered whose names have a part that
            begins with an underscore.
        send_buffer_limit: How many bytes of messages may wait for a client before it loses old
            ones.
        use_sim_time: Take times from ``/clock``.
        capabilities: What is offered of :data:`.protocol.CAPABILITIES`.
        asset_uri_allowlist: Regular expressions of the files that clients may read.
        origins: Web pages that may connect, besides Foxglove's and this machine's: what
            their browser sends as ``Origin``.
    """

    port: int = DEFAULT_PORT
    address: str = "127.0.0.1"
    topic_whitelist: tuple[str, ...] = _ALL
    service_whitelist: tuple[str, ...] = _ALL
    param_whitelist: tuple[str, ...] = _ALL
    client_topic_whitelist: tuple[str, ...] = _ALL
    include_hidden: bool = False
    send_buffer_limit: int = 10_000_000
    use_sim_time: bool = False
    capabilities: tuple[str, ...] = CAPABILITIES
    asset_uri_allowlist: tuple[str, ...] = (ASSETS,)
    origins: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        """Check all of it.

        Raises:
            ValueError: A value is out of its range; the text names it.
        """
        if not 0 <= self.port <= 65535:
            raise ValueError(f"port {self.port} does not exist: ports are 0 (a free one) to 65535")
        if self.send_buffer_limit < 1:
            raise ValueError(f"send_buffer_limit is at least 1 byte, got {self.send_buffer_limit}")
        unknown = sorted({*self.capabilities} - {*CAPABILITIES})
        if unknown:
            raise ValueError(
                f"there is no capability {', '.join(map(repr, unknown))}; "
                f"choose from {', '.join(CAPABILITIES)}"
            )
        for name in (
            "topic_whitelist",
            "service_whitelist",
            "param_whitelist",
            "client_topic_whitelist",
            "asset_uri_allowlist",
        ):
            Patterns(getattr(self, name), name)

    @property
    def is_local(self) -> bool:
        """True if only programs of this machine reach the server."""
        return self.address in {"localhost", "::1"} or self.address.startswith("127.")

    @property
    def warning(self) -> str:
        """Warning to the user that other computers reach the server."""
        rights = ["read all topics"]
        if "clientPublish" in self.capabilities:
            rights.append("publish")
        if "services" in self.capabilities:
            rights.append("call services")
        return f"Anyone who can reach {self.address} can {', '.join(rights)}."

    def patterns(self, name: str) -> Patterns:
        """Return the compiled expressions of one of the lists."""
        return Patterns(getattr(self, name), name)
