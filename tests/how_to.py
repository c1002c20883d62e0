"""Pages of the documentation, whose blocks tests run."""

from __future__ import annotations

import doctest
import re
import time
from collections.abc import Callable


def blocks(page: str) -> list[tuple[str, str]]:
    """Return the kind and the text of each block of code."""
    return re.findall(r"^```(\w+)\n(.*?)^```$", page, re.MULTILINE | re.DOTALL)


def blocks_of(page: str, kind: str) -> list[str]:
    """Return the texts of the blocks of a kind."""
    return [text for each, text in blocks(page) if each == kind]


def wait_until_printed(wanted: str, command: Callable[[], str]) -> None:
    """Repeat a command until it prints what is wanted, in which `...` stands for any text.

    A page gives a command two seconds, in which a busy machine may not find another node.
    """
    limit = time.monotonic() + 60
    options = doctest.ELLIPSIS | doctest.DONT_ACCEPT_BLANKLINE
    while not doctest.OutputChecker().check_output(wanted, printed := command(), options):
        assert time.monotonic() < limit, printed
