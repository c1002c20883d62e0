"""Datagrams to and from a multicast group."""

from __future__ import annotations

from ros2cli.multicast import MulticastSocket

__all__ = ["DEFAULT_GROUP", "DEFAULT_PORT", "receive", "send"]

DEFAULT_GROUP = "225.0.0.1"
DEFAULT_PORT = 49150


def receive(
    *, group: str = DEFAULT_GROUP, port: int = DEFAULT_PORT, timeout: float | None = None
) -> tuple[bytes, tuple[str, int]]:
    """Wait for a datagram; its bytes, and host and port of its sender.

    Args:
        group: Address of the group.
        port: UDP port.
        timeout: Seconds to wait; None waits without a limit.

    Raises:
        TimeoutError: None came in time.
    """
    with MulticastSocket(group, port) as multicast:
        return multicast.receive(timeout)


def send(
    data: bytes, *, group: str = DEFAULT_GROUP, port: int = DEFAULT_PORT, ttl: int | None = None
) -> None:
    """Send a datagram.

    Args:
        data: Its bytes.
        group: Address of the group.
        port: UDP port.
        ttl: How many routers it may pass; None leaves it to the system.
    """
    with MulticastSocket(group, port, ttl) as multicast:
        multicast.send(data)
