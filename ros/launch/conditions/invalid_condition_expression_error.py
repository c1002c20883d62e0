"""The error of conditions whose text is neither true nor false."""

from __future__ import annotations

__all__ = ["InvalidConditionExpressionError"]


class InvalidConditionExpressionError(Exception):
    """The text of a condition is neither true nor false."""
