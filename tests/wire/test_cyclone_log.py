"""Cyclone's complaints are passed on in our words, each kind once."""

from __future__ import annotations

import os
import subprocess
import sys
import threading

import pytest

from turtlewire.wire.cyclone.log import CycloneLog, explain

pytestmark = pytest.mark.skipif(
    sys.platform == "win32", reason="there Cyclone writes on stderr itself"
)


def test_a_datagram_that_the_network_refuses_is_explained():
    text = explain("ddsi_udp_conn_write to udp/10.77.0.2:23411 failed with retcode -1")
    assert text.startswith("the network does not let us send to 10.77.0.2: is the link down?")
    assert explain("something else") == "Cyclone DDS says: something else"


def test_what_cyclone_says_of_a_domain_goes_into_the_pipe():
    """In a process of its own: Cyclone keeps the first stderr that it sees for what belongs to no domain."""
    code = (
        "from turtlewire.wire.cyclone import library as dds\n"
        "from turtlewire.wire.cyclone.log import CycloneLog\n"
        "log = CycloneLog()\n"
        "with log.capturing():\n"
        "    assert dds.create_domain(3, b'<Nonsense>') < 0\n"
        "print(log.unread(), log.unread())\n"
    )
    done = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, timeout=60, check=True
    )
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
    before = threading.active_count()
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
    assert threading.active_count() == before
    assert said == ["Cyclone DDS says: thing 0 failed", "Cyclone DDS says: another thing"]


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
