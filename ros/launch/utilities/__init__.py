"""Small helpers that actions and substitutions share."""

from __future__ import annotations

from launch.utilities.substitutions import normalize_to_list_of_substitutions, perform_substitutions
from launch.utilities.type_checks import ensure_argument_type, is_a, is_a_subclass

__all__ = [
    "ensure_argument_type",
    "is_a",
    "is_a_subclass",
    "normalize_to_list_of_substitutions",
    "perform_substitutions",
]
