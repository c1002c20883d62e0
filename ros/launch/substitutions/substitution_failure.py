"""The error of substitutions that have no text."""

from __future__ import annotations

__all__ = ["SubstitutionFailure"]


class SubstitutionFailure(RuntimeError):
    """A substitution has no text here; the message says why."""
