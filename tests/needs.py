"""What some tests need: software that a bare machine lacks and how to install it, or much time."""

from typing import Any

import pytest

from turtlewire.wire.environment import is_installed

COMPILED_CORE = "needs the compiled core (Debian: apt install g++ python3-dev; then scripts/setup)"

HAS_CYCLONE_DDS = is_installed("rmw_cyclonedds_cpp")
CYCLONE_DDS = (
    "needs Cyclone DDS: where its wheel does not exist (Python 3.14, arm64), apt install "
    "libddsc0t64 (before Debian 13: libddsc0debian)"
)
needs_cyclone_dds = pytest.mark.skipif(not HAS_CYCLONE_DDS, reason=CYCLONE_DDS)


def only_first_is_fast(first: Any, *others: Any) -> list[Any]:
    """Return values for `parametrize`; the others, which take long, are for the slow tests."""
    return [first, *(pytest.param(other, marks=pytest.mark.slow) for other in others)]
