"""The pytest fixture; name this module in ``pytest_plugins``."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from turtlesim.testing.simulation import Simulation


@pytest.fixture
def simulation() -> Iterator[Simulation]:
    """Yield a fresh simulation with turtle1 in the middle; ends with the test."""
    with Simulation() as fresh:
        yield fresh
