"""What keeps a command from running."""

from __future__ import annotations

__all__ = ["ClassError"]


class ClassError(Exception):
    """An error whose text says what was asked, what exists and what to do."""
