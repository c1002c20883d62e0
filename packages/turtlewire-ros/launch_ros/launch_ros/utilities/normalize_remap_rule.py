"""Remapping rules as pairs of substitutions."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING, Any

from launch.utilities import ensure_argument_type, normalize_to_list_of_substitutions

if TYPE_CHECKING:
    from launch.substitution import Substitution

_Rule = tuple[tuple["Substitution", ...], tuple["Substitution", ...]]


def normalize_remap_rule(remap_rule: Any) -> _Rule:
    """Return a pair of text or substitutions as a pair of tuples of substitutions.

    Raises:
        TypeError: The rule is not a pair of strings or substitutions.
    """
    ensure_argument_type(remap_rule, (tuple, list), "remap_rule")
    if len(remap_rule) != 2:
        raise TypeError(
            f"remap_rule must be a tuple of length 2, but got length {len(remap_rule)}: "
            f"{remap_rule}"
        )
    source, target = (tuple(normalize_to_list_of_substitutions(part)) for part in remap_rule)
    return source, target


def normalize_remap_rules(remap_rules: Iterable[Any]) -> Iterator[_Rule]:
    """Return each of several rules, normalized."""
    return (normalize_remap_rule(rule) for rule in remap_rules)
