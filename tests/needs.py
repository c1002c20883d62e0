"""Requirements of some tests that a bare machine does not meet, and how to install them."""

import pytest

from turtlewire.wire.environment import is_installed

COMPILED_CORE = "needs the compiled core (Debian: apt install g++ python3-dev; then scripts/setup)"

HAS_CYCLONE_DDS = is_installed("rmw_cyclonedds_cpp")
CYCLONE_DDS = (
    "needs Cyclone DDS: where its wheel does not exist (Python 3.14, arm64), apt install "
    "libddsc0t64 (before Debian 13: libddsc0debian)"
)
needs_cyclone_dds = pytest.mark.skipif(not HAS_CYCLONE_DDS, reason=CYCLONE_DDS)
