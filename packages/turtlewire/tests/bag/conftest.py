"""The golden bags of a real rosbag2."""

import pytest
from tests.bags import write_bag

from tests import places

GOLDEN = places.GOLDEN / "bag"

#: Bags of the real rosbag2 with all its answers: MCAP, split MCAP compressed by file, and sqlite3
#: compressed by message.
ANSWERED = ["d_mcap", "d_split_file_zstd", "d_sqlite3_message_zstd"]


@pytest.fixture
def bag_path(tmp_path):
    return write_bag(tmp_path / "made")
