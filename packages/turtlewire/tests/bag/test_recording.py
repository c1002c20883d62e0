"""Messages that a recording keeps and loses at the limit of its cache."""

from __future__ import annotations

import threading

import pytest

from turtlewire.bag.recording import Recording


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
