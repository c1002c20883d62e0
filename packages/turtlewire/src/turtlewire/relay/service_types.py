"""The type hashes of a service, from installed definitions and from announcements."""

from __future__ import annotations

from typing import TYPE_CHECKING

from turtlewire import msg
from turtlewire.errors import InterfaceError
from turtlewire.wire.base import ServiceTypes, TypeId

if TYPE_CHECKING:
    from collections.abc import Iterable

    from turtlewire.wire.base import EndpointInfo

__all__ = ["installed_hash", "service_types"]


def service_types(
    type_name: str, on_dds: Iterable[EndpointInfo], on_zenoh: Iterable[EndpointInfo]
) -> ServiceTypes:
    """Return the types of a service; a hash that is not known is empty.

    On DDS, the two halves of a service announce the hashes of their own types. On Zenoh, both
    announce the hash of the service, which cannot be computed from those. So the hash of a service
    without an installed definition is known only once an end on Zenoh has announced it.

    Args:
        type_name: Name of the type (``turtlesim/srv/Spawn``).
        on_dds: Its servers and clients on DDS.
        on_zenoh: Its servers and clients on Zenoh.
    """
    parts = f"{type_name}_Request", f"{type_name}_Response"
    announced = {each.type_name: each.type_hash for each in on_dds if each.type_hash}
    installed = {name: installed_hash(name) for name in (type_name, *parts)}
    is_another = any(announced.get(part, installed[part]) != installed[part] for part in parts)
    hashes = (each.type_hash for each in on_zenoh if each.type_name in parts)
    whole = next(hashes, "" if is_another else installed[type_name])
    request, response = (TypeId(part, announced.get(part, installed[part])) for part in parts)
    return ServiceTypes(type_name, request, response, lambda _: whole)


def installed_hash(type_name: str) -> str:
    """Return the hash of an installed definition; empty if it is not installed."""
    try:
        return msg.type_hash(type_name)
    except InterfaceError:
        return ""
