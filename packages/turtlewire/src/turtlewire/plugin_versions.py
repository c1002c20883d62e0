"""Versions of the interfaces that extensions are written for, and the ranges that fit them."""

from __future__ import annotations

__all__ = ["PluginException", "get_upper_bound_caret_version", "satisfies_version"]


class PluginException(Exception):
    """An extension is for another version of the program that it extends."""


def satisfies_version(version: str, caret_range: str) -> None:
    """Check that a version is in a caret range.

    Args:
        version: For example ``0.1``.
        caret_range: For example ``^0.1``: the same until the first number that is not zero.

    Raises:
        PluginException: The version is too old or too new.
    """
    assert caret_range.startswith("^"), "expected a range that begins with ^"
    lower = _numbers(caret_range[1:])
    if _numbers(version) < lower:
        raise PluginException(f"Extension point version {version} is too old for {caret_range}")
    if _numbers(version) >= _numbers(get_upper_bound_caret_version(caret_range[1:])):
        raise PluginException(f"Extension point version {version} is too new for {caret_range}")


def get_upper_bound_caret_version(version: str) -> str:
    """Return the first version that is outside of a caret range: ``0.2`` for ``0.1``."""
    numbers = _numbers(version)
    place = next((index for index, number in enumerate(numbers) if number), len(numbers) - 1)
    upper = [*numbers[:place], numbers[place] + 1, *[0] * (len(numbers) - place - 1)]
    return ".".join(map(str, upper))


def _numbers(version: str) -> list[int]:
    return [int(part) for part in version.split(".")]
