"""Splits the words of a command by its keywords, as ``cmake_parse_arguments`` does."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Iterable

__all__ = ["Parsed", "parse_keywords"]


class Parsed(NamedTuple):
    """The words of a command.

    Attributes:
        options: Which options were given.
        values: The value of each keyword with one value.
        lists: The values of each keyword with several.
        rest: What belongs to no keyword.
    """

    options: frozenset[str]
    values: dict[str, str]
    lists: dict[str, list[str]]
    rest: list[str]


def parse_keywords(
    words: Iterable[str],
    options: Iterable[str] = (),
    values: Iterable[str] = (),
    lists: Iterable[str] = (),
) -> Parsed:
    """Take words apart by keywords.

    Args:
        words: The words of the command.
        options: Keywords without a value.
        values: Keywords with one value.
        lists: Keywords with any number of values.
    """
    options, values, lists = frozenset(options), frozenset(values), frozenset(lists)
    found = Parsed(frozenset(), {}, {}, [])
    given: set[str] = set()
    keyword = ""
    for word in words:
        if word in options:
            given.add(word)
            keyword = ""
        elif word in values or word in lists:
            keyword = word
            if word in lists:
                found.lists.setdefault(word, [])
        elif keyword in values:
            found.values[keyword] = word
            keyword = ""
        elif keyword:
            found.lists[keyword].append(word)
        else:
            found.rest.append(word)
    return found._replace(options=frozenset(given))
