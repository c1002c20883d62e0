"""Cyclone's complaints are passed on in our words, a few in a minute."""

from __future__ import annotations

import hashlib
import os
import sys
import threading
import tracemalloc

import pytest
from tests.programs import run_python

from turtlewire.wire.cyclone.log import CycloneLog, LineLimiter, explain

pytestmark = pytest.mark.skipif(
    sys.platform == "win32", reason="there Cyclone writes on stderr itself"
)


def test_a_datagram_that_the_network_refuses_is_explained():
    text = explain("ddsi_udp_conn_write to udp/10.77.0.2:23411 failed with retcode -1")
    assert text.startswith("the network rejects packets to 10.77.0.2: is the link down?")
    assert explain("something else") == "Cyclone DDS says: something else"


def test_cyclone_log_of_a_domain_goes_into_the_pipe():
    """Runs in a separate process.

    Cyclone keeps the first stderr that it sees for what belongs to no domain.
    """
    code = (
        "from turtlewire.wire.cyclone import library as dds\n"
        "from turtlewire.wire.cyclone.log import CycloneLog\n"
        "log = CycloneLog()\n"
        "with log.capturing():\n"
        "    assert dds.create_domain(3, b'<Nonsense>') < 0\n"
        "print(log.unread(), log.unread())\n"
    )
    done = run_python(code, timeout=300)
    assert "Nonsense: unknown element" in done.stdout
    assert done.stdout.endswith("] []\n")
    assert done.stderr == ""


def test_many_lines_of_one_kind_are_one_warning_and_the_thread_ends(monkeypatch):
    said: list[str] = []
    all_read = threading.Event()

    def warn(text: str) -> None:
        said.append(text)
        if "another" in text:
            all_read.set()

    monkeypatch.setattr("turtlewire.wire.cyclone.log.warn", warn)
    before = {*threading.enumerate()}  # one of another test may be ending
    log = CycloneLog()
    log.start()
    log.start()
    for number in range(500):
        os.write(
            log._write_end,
            f"1795266048.35{number} [64]        tev: thing {number} failed\n".encode(),
        )
    os.write(log._write_end, b"1795266048.352094 [64]        tev: another thing\n")
    assert all_read.wait(60)
    log.stop()
    log.stop()
    assert not {*threading.enumerate()} - before
    assert said == ["Cyclone DDS says: thing 0 failed", "Cyclone DDS says: another thing"]


def word(number: int) -> str:
    """Return a different word for each number."""
    digits = hashlib.sha256(number.to_bytes(4, "big")).hexdigest()
    return digits.translate(str.maketrans("0123456789abcdef", "ghijklmnopqrstuv"))


def test_a_flood_of_ever_new_lines_is_a_few_sentences_and_a_summary():
    limiter = LineLimiter()
    said = []
    for number in range(30_000):
        said += limiter.sentences(f"malformed {word(number)}", number / 1000)
    assert len(said) == 5
    assert limiter.summary(59.9) == []
    [summary] = limiter.summary(60.0)
    assert summary.endswith("(the last of 29995 more lines)")
    assert limiter.summary(120.0) == []
    assert limiter.period_end is None


def test_a_flood_leaves_no_memory_behind():
    limiter = LineLimiter()
    words = [word(number) for number in range(2000)]

    def flood(start: int) -> None:
        for number, each in enumerate(words):
            limiter.sentences(f"malformed {each}", start + number / 10)

    flood(0)
    tracemalloc.start()
    flood(1000)
    size, _ = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert size < 20_000


def test_dumps_and_numbers_make_no_kinds():
    limiter = LineLimiter()
    assert len(limiter.sentences("malformed packet UNKNOWN(e6) <52545053 aabb>", 0.0)) == 1
    assert limiter.sentences("malformed packet UNKNOWN(43) <52545053 ccdd>", 0.0) == []


def test_a_kind_is_said_again_in_the_next_period():
    limiter = LineLimiter()
    assert limiter.sentences("thing 1 failed", 0.0) == ["Cyclone DDS says: thing 1 failed"]
    assert limiter.sentences("thing 2 failed", 59.0) == []
    assert limiter.sentences("thing 3 failed", 61.0) == [
        "Cyclone DDS says: thing 2 failed (the last of 1 more lines)",
        "Cyclone DDS says: thing 3 failed",
    ]


def test_a_long_line_is_cut():
    assert explain("x" * 10_000) == f"Cyclone DDS says: {'x' * 300}…"


def test_the_summary_comes_without_another_line(monkeypatch):
    """The thread waits no longer than the period lasts."""
    said: list[str] = []
    summarised = threading.Event()

    def warn(text: str) -> None:
        said.append(text)
        if "more lines" in text:
            summarised.set()

    monkeypatch.setattr("turtlewire.wire.cyclone.log.warn", warn)
    monkeypatch.setattr("turtlewire.wire.cyclone.log._PERIOD_S", 0.2)
    log = CycloneLog()
    log.start()
    os.write(log._write_end, b"thing 1 failed\nthing 2 failed\n")
    assert summarised.wait(60)
    log.stop()
    assert said[-1] == "Cyclone DDS says: thing 2 failed (the last of 1 more lines)"


def fill(pipe: int) -> None:
    while True:
        os.write(pipe, b"x" * 4096)


def test_a_full_pipe_never_blocks_and_the_thread_still_ends():
    log = CycloneLog()
    with pytest.raises(BlockingIOError):
        fill(log._write_end)
    os.read(log._read_end, 4096)
    os.write(log._write_end, b"\n" * 4096)
    log.start()
    log.stop()


@pytest.mark.parametrize(
    ("line", "is_said"),
    [
        (
            "malformed packet received from vendor 1.15 state parse:UNKNOWN(80) <52545053 @0x0",
            False,
        ),
        ("malformed packet received from vendor 1.16 state parse:UNKNOWN(80) <52545053 @0x0", True),
        ("malformed packet received from vendor 1.15 state parse:DATA <52545053 @0x0", True),
        (
            "invalid parameter list (vendor 1.15, version 2.2): pid 5a (ENDPOINT_GUID) invalid, i",
            False,
        ),
        ("Invalid PublicationBuiltinTopicData (vendor 1.15): invalid qos/parameters", False),
        ("Invalid PublicationBuiltinTopicData (vendor 1.16): invalid qos/parameters", True),
    ],
)
def test_the_statistics_of_fast_dds_are_no_trouble(line, is_said):
    log = CycloneLog()
    os.write(log._write_end, f"1795266048.352094 [64]       recv: {line}\n".encode())
    assert log.unread() == ([line] if is_said else [])
