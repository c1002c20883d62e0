"""Messages that a recording keeps and loses at the limit of its cache."""

import threading

import pytest

from turtlewire.bag import BagWriter, open_bag
from turtlewire.bag.file_series import FileSeries
from turtlewire.bag.recording import Recording
from turtlewire.errors import BagError


class Disk:
    """A writer that keeps its messages; it is as slow as the test wants."""

    def __init__(self):
        self.messages, self.is_free, self.is_asked = [], threading.Event(), threading.Event()

    def write(self, topic, data, log_time_ns, publish_time_ns):
        self.is_asked.set()
        assert self.is_free.wait(60)
        self.messages.append((data, log_time_ns, publish_time_ns))

    def flush(self):
        pass

    def close(self):
        pass


@pytest.fixture
def disk():
    disk = Disk()
    yield disk
    disk.is_free.set()


@pytest.mark.parametrize(("last", "kept"), [(b"6bytes", [1, 2]), (b"7 bytes", [2])])
def test_a_snapshot_keeps_the_newest_messages_that_fit(disk, last, kept):
    disk.is_free.set()
    recording = Recording(disk, cache_bytes=10, snapshot=True)
    recording.write("/a", b"four", 1)
    recording.write("/a", last, 2)
    assert recording.take_snapshot()
    recording.close()
    assert [stamp for _, stamp, _ in disk.messages] == kept


def test_a_topic_may_be_named_for_repetition_again(tmp_path):
    with BagWriter(tmp_path / "bag") as writer:
        writer.add_topic("/map", "std_msgs/msg/String")
        recording = Recording(writer)
        recording.repeat("/map", 2)
        recording.write("/map", bytes(8), 1)
        recording.split()
        recording.repeat("/map", 2)
        recording.split()
        recording.close()
    assert [file.message_count for file in writer.metadata.files] == [1, 1, 1]


@pytest.mark.parametrize(
    ("cache_bytes", "kept"), [(0, [20, 25, 30]), (100, [20, 25, 30]), (8, [25, 30])]
)
def test_a_snapshot_keeps_the_messages_of_a_span(disk, cache_bytes, kept):
    disk.is_free.set()
    recording = Recording(disk, cache_bytes=cache_bytes, cache_ns=10, snapshot=True)
    for stamp in (10, 19, 20, 25, 30):
        recording.write("/a", b"four", stamp)
    assert recording.take_snapshot()
    recording.close()
    assert [stamp for _, stamp, _ in disk.messages] == kept


def test_a_snapshot_needs_a_limit(disk):
    with pytest.raises(BagError, match="snapshots need a limit"):
        Recording(disk, cache_bytes=0, snapshot=True)


@pytest.mark.parametrize(("last", "lost"), [(b"6bytes", {}), (b"7 bytes", {"/a": 1})])
def test_a_full_cache_loses_what_does_not_fit(disk, last, lost):
    recording = Recording(disk, cache_bytes=10)
    recording.write("/a", b"a message larger than the cache", 1)
    assert disk.is_asked.wait(60)  # nothing waits in the cache, and the disk is busy
    recording.write("/a", b"four", 2)
    recording.write("/a", last, 3)
    assert recording.lost == lost
    assert recording.status.messages == 3
    disk.is_free.set()
    recording.close()
    assert len(disk.messages) == 3 - len(lost)


@pytest.mark.parametrize(
    ("refused", "why"), [((b"", 2), "not 0 bytes"), ((bytes(8), -2), "no times before 1970")]
)
def test_a_message_that_no_bag_can_hold_does_not_end_the_recording(tmp_path, refused, why):
    recording = Recording(BagWriter(tmp_path / "bag"))
    recording.add_topic("/a", "std_msgs/msg/String")
    for data, stamp in ((bytes(8), 1), refused, refused, (bytes(8), 3)):
        recording.write("/a", data, stamp)
    recording.close()
    count, reason = recording.refused["/a"]
    assert (count, why in reason, recording.failure, recording.lost) == (2, True, None, {})
    with open_bag(tmp_path / "bag") as bag:
        assert [message.log_time_ns for message in bag] == [1, 3]


@pytest.mark.parametrize("sent_ns", [None, 0, -5, 5])
def test_a_sender_with_a_wrong_clock_is_recorded(tmp_path, sent_ns):
    recording = Recording(BagWriter(tmp_path / "bag"))
    recording.add_topic("/a", "std_msgs/msg/String")
    recording.write("/a", bytes(8), 7, sent_ns)
    recording.close()
    with open_bag(tmp_path / "bag") as bag:
        (message,) = bag
    assert message.publish_time_ns == (5 if sent_ns == 5 else 7)


@pytest.mark.parametrize("snapshot", [False, True])
def test_a_recording_whose_bag_cannot_begin_another_file_ends_quietly(
    tmp_path, monkeypatch, snapshot
):
    def full(*_):
        raise OSError(28, "No space left on device")

    recording = Recording(BagWriter(tmp_path / "bag"), snapshot=snapshot)
    recording.add_topic("/a", "std_msgs/msg/String")
    monkeypatch.setattr(FileSeries, "_new_file", full)
    with pytest.raises(OSError, match="No space left"):
        recording.split()
    if snapshot:
        recording.write("/a", bytes(8), 1)
        assert not recording.take_snapshot()
    recording.close()
    assert "No space left" in str(recording.failure)
    assert recording.lost == ({"/a": 1} if snapshot else {})
    assert recording.refused == {}
