"""Parses the networks of a relay: ``cyclonedds:0``, ``zenoh:7``."""

from __future__ import annotations

from typing import NamedTuple

from turtlewire.wire.environment import MAX_DOMAIN_ID

__all__ = ["End", "parse_end"]

_MIDDLEWARES = {"cyclonedds": "rmw_cyclonedds_cpp", "zenoh": "rmw_zenoh_cpp"}
_FAST_DDS = {"fastdds", "fastrtps", "rmw_fastrtps_cpp", "rmw_fastrtps_dynamic_cpp"}


class End(NamedTuple):
    """One of the two networks.

    Attributes:
        middleware: ``rmw_cyclonedds_cpp`` or ``rmw_zenoh_cpp``.
        domain_id: The domain.
    """

    middleware: str
    domain_id: int

    @property
    def is_zenoh(self) -> bool:
        """True if the middleware is Zenoh."""
        return self.middleware == _MIDDLEWARES["zenoh"]

    def __str__(self) -> str:
        return f"{'zenoh' if self.is_zenoh else 'cyclonedds'}:{self.domain_id}"


def parse_end(text: str) -> End:
    """Read ``cyclonedds:0`` or ``zenoh:7``.

    Raises:
        ValueError: The text names no network; the message shows the format.
    """
    name, _, domain = text.partition(":")
    if name in _FAST_DDS:
        raise ValueError(
            f"{text!r}: nodes on Fast DDS are reached with cyclonedds:{domain or 'DOMAIN'}, which "
            "carries between Cyclone DDS and Fast DDS as well"
        )
    middleware = _MIDDLEWARES.get(name, name)
    if middleware not in _MIDDLEWARES.values():
        raise ValueError(f"{text!r} is not cyclonedds:DOMAIN or zenoh:DOMAIN")
    if not (domain.isascii() and domain.isdigit() and int(domain) <= MAX_DOMAIN_ID):
        raise ValueError(
            f"{text!r}: expected a domain from 0 to {MAX_DOMAIN_ID} after the colon, as in {name}:0"
        )
    return End(middleware, int(domain))
