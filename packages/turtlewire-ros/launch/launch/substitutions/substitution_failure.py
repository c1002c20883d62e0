"""The error of substitutions that have no text."""

from __future__ import annotations


class SubstitutionFailure(RuntimeError):
    """A substitution has no text here; the message says why.

    Args:
        msg: Why.
        hint: Advice.
    """

    def __init__(self, msg: str = "", *, hint: str = "") -> None:
        super().__init__(msg)
        self.hint = hint
