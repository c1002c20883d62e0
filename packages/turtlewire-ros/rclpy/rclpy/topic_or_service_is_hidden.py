"""Names that tools leave out of their lists."""

from __future__ import annotations

from .validate_topic_name import TOPIC_SEPARATOR_STRING

#: A part of a hidden name begins so.
HIDDEN_TOPIC_PREFIX = "_"


def topic_or_service_is_hidden(name: str) -> bool:
    """Return True if a name part begins with an underscore: ``/fibonacci/_action/status``."""
    return any(
        token.startswith(HIDDEN_TOPIC_PREFIX) for token in name.split(TOPIC_SEPARATOR_STRING)
    )
