"""Converting bags: no files remain after an early end."""

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


@pytest.mark.parametrize(
    ("start_ns", "end_ns", "written"),
    [
        (-1, -1, [0, 10, 20, 30]),
        (0, 0, [0]),
        (10, 20, [10, 20]),
        (11, 19, []),
        (9, 21, [10, 20]),
        (30, -1, [30]),
        (31, -1, []),
    ],
)
def test_both_ends_of_an_output_belong_to_it(tmp_path, start_ns, end_ns, written):
    with BagWriter(tmp_path / "bag") as writer:
        writer.add_topic("/a", "std_msgs/msg/String")
        for time in (0, 10, 20, 30):
            writer.write("/a", bytes(8), time)
    output = BagWriter(tmp_path / "part")
    with open_bag(tmp_path / "bag") as bag:
        rewrite([bag], [Output(output, RecordOptions(all_topics=True), start_ns, end_ns)])
    with open_bag(tmp_path / "part") as bag:
        assert [message.log_time_ns for message in bag] == written
