"""Names that tools leave out of their lists."""

from __future__ import annotations

__all__ = ["topic_or_service_is_hidden"]

_HIDDEN_PREFIX = "_"


def topic_or_service_is_hidden(name: str) -> bool:
    """Whether a part of the name begins with an underscore, as in ``/fibonacci/_action/status``."""
    return any(token.startswith(_HIDDEN_PREFIX) for token in name.split("/"))
