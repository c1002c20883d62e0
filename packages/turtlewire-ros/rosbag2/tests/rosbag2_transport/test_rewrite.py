"""Converting bags: what is left when it ends early."""

from __future__ import annotations

import pytest
from tests.places import GOLDEN

from rosbag2_transport.options import RecordOptions
from rosbag2_transport.rewrite import Output, rewrite
from turtlewire.bag import BagWriter, open_bag

SMALL = GOLDEN / "bag" / "p_small"


def test_an_interrupted_conversion_says_so_and_leaves_no_half_bag(tmp_path, capfd):
    def interrupt(*_):
        raise KeyboardInterrupt

    writer = BagWriter(tmp_path / "half", max_file_ns=1_000_000_000)
    writer.on_split = interrupt  # after a second of the bag
    with open_bag(SMALL) as bag, pytest.raises(KeyboardInterrupt):
        rewrite([bag], [Output(writer, RecordOptions(all_topics=True))])
    lines = capfd.readouterr().err.splitlines()
    assert len(lines) == 1
    assert "what was converted is incomplete and removed" in lines[0]
    assert str(tmp_path / "half") in lines[0]
    assert not (tmp_path / "half").exists()
