"""The findings of the doctor."""

from __future__ import annotations

from typing import NamedTuple


class Finding(NamedTuple):
    """A fault, or something worth knowing.

    Attributes:
        is_problem: Whether it keeps something from working.
        text: What is so.
        remedy: What to do.
    """

    is_problem: bool
    text: str
    remedy: str


def problem(text: str, remedy: str) -> Finding:
    """Return a finding that keeps something from working."""
    return Finding(True, text, remedy)


def note(text: str, remedy: str) -> Finding:
    """Return a finding that is only worth knowing."""
    return Finding(False, text, remedy)
