"""A disk that is full, as far as the files of this process can tell."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager

import pytest


@contextmanager
def full_disk(size: int = 0) -> Iterator[None]:
    """Limit the size of all files that this process writes; beyond it, a write raises OSError.

    The limit is one of Unix: elsewhere, the test is skipped.
    """
    if sys.platform == "win32":
        pytest.skip("limits of Unix")
    import resource

    limits = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, limits[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, limits)
