"""Topics that carry the introspection events of services."""

from __future__ import annotations

__all__ = ["is_service_event", "service_of"]

_EVENT_TOPIC, _EVENT_TYPE = "/_service_event", "_Event"


def is_service_event(topic: str, type_name: str) -> bool:
    """Return True if a topic carries the introspection events of a service."""
    return topic.endswith(_EVENT_TOPIC) and type_name.endswith(_EVENT_TYPE)


def service_of(topic: str, type_name: str) -> tuple[str, str]:
    """Name and type of the service whose events a topic carries."""
    return topic.removesuffix(_EVENT_TOPIC), type_name.removesuffix(_EVENT_TYPE)
