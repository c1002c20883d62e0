"""The clock of a playback, and reading ahead."""

import threading

import pytest
from hypothesis import given
from hypothesis import strategies as st

from turtlewire.bag import BagMessage
from turtlewire.bag.playback import PlayClock, ReadAhead
from turtlewire.errors import BagError

SECOND = 1_000_000_000


class Monotonic:
    """A clock that a test moves."""

    def __init__(self):
        self.now = 5 * SECOND

    def __call__(self):
        return self.now


@pytest.fixture
def monotonic():
    return Monotonic()


def test_it_runs_at_its_rate_and_stands_still(monotonic):
    clock = PlayClock(100 * SECOND, 2.0, monotonic_ns=monotonic)
    monotonic.now += SECOND
    assert clock.now_ns() == 102 * SECOND
    assert clock.seconds_until(106 * SECOND) == 2.0
    assert clock.seconds_until(101 * SECOND) == 0.0
    assert PlayClock(0, 1e-300).seconds_until(SECOND) == threading.TIMEOUT_MAX
    clock.pause()
    monotonic.now += 10 * SECOND
    assert clock.now_ns() == 102 * SECOND
    clock.set_rate(0.5)
    clock.resume()
    monotonic.now += 2 * SECOND
    assert clock.now_ns() == 103 * SECOND
    clock.jump(50 * SECOND)
    assert clock.now_ns() == 50 * SECOND


@given(
    st.lists(
        st.tuples(
            st.sampled_from(["pause", "resume", "rate"]),
            st.floats(0.01, 100.0),
            st.integers(0, 10 * SECOND),
        )
    )
)
def test_no_command_makes_it_jump(commands):
    monotonic = Monotonic()
    clock = PlayClock(0, monotonic_ns=monotonic)
    for name, rate, elapsed in commands:
        before = clock.now_ns()
        if name == "rate":
            clock.set_rate(rate)
        else:
            getattr(clock, name)()
        assert clock.now_ns() == before
        monotonic.now += elapsed
        expected = 0 if clock.is_paused else int(elapsed * clock.rate)
        assert clock.now_ns() == before + expected


def messages(count):
    return [BagMessage("/a", "t", i, i, b"") for i in range(count)]


@pytest.mark.parametrize("size", [-1, 0, 1, 2, 3, 1000])
def test_all_messages_come_in_order(size):
    source = ReadAhead(iter(messages(500)), size)
    found = []
    while (message := source.peek()) is not None:
        assert source.peek() is message
        source.pop()
        found.append(message)
    assert found == messages(500)
    source.close()


def test_it_reads_no_more_than_it_keeps():
    taken = []
    several = threading.Event()

    def count():
        for message in messages(100):
            taken.append(message)
            if len(taken) > 5:
                several.set()
            yield message

    source = ReadAhead(count(), 5)
    assert several.wait(60)
    source.close()  # ends the thread although nobody takes what it read
    assert len(taken) == 6


@pytest.mark.parametrize("size_bytes", [1, 1000, 10_000])
def test_large_messages_are_not_all_kept(size_bytes):
    taken = []

    def read():
        for i in range(200):
            taken.append(i)
            yield BagMessage("/a", "t", i, i, bytes(1000))

    source = ReadAhead(read(), 1000, size_bytes)
    found = []
    while (message := source.peek()) is not None:
        # One more has been read, and waits for room.
        assert len(taken) - len(found) <= max(1, size_bytes // 1000) + 1
        found.append(message.log_time_ns)
        source.pop()
    assert found == list(range(200))
    source.close()


def test_damage_is_told_behind_what_can_be_read():
    def damaged():
        yield from messages(2)
        raise BagError("damaged")

    source = ReadAhead(damaged())
    for _ in range(2):
        assert source.peek() is not None
        source.pop()
    with pytest.raises(BagError, match="damaged"):
        source.peek()
    source.close()
