"""Hands messages to the callback of a subscription."""

from __future__ import annotations

from typing import TYPE_CHECKING

from turtlewire.guarded import call_guarded

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from .base import MessageInfo

__all__ = ["deliver"]


def deliver(
    messages: Iterable[tuple[bytes, MessageInfo]],
    on_message: Callable[[bytes, MessageInfo], None],
    is_closed: Callable[[], bool],
) -> None:
    """Call ``on_message`` for each message until the subscription is closed."""
    for message in messages:
        if is_closed():
            return
        call_guarded(on_message, *message)
