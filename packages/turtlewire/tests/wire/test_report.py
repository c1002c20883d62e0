"""Warnings of the wire: each once, and bounded memory for which were said."""

import io
import sys

import pytest

from turtlewire.wire import report
from turtlewire.wire.conflicts import NodeNames


def test_each_is_said_once(monkeypatch, capfd):
    monkeypatch.setattr(report, "_said", set())
    for _ in range(3):
        report.warn_once("a", "the first")
    report.warn_once("b", "the second")
    assert [line.rpartition(": ")[2] for line in capfd.readouterr().err.splitlines()] == [
        "the first",
        "the second",
    ]


def test_names_that_come_and_go_for_ever_do_not_fill_the_memory(monkeypatch, capfd):
    said = set()
    monkeypatch.setattr(report, "_said", said)
    for number in range(5000):
        report.warn_once(f"topic {number}", "a mistake")
    capfd.readouterr()
    assert len(said) <= 1000


@pytest.mark.parametrize(("keys", "said"), [(1000, 0), (1001, 1)])
def test_a_thousand_warnings_are_remembered(monkeypatch, capfd, keys, said):
    monkeypatch.setattr(report, "_said", set())
    for number in range(keys):
        report.warn_once(f"topic {number}", "a mistake")
    capfd.readouterr()
    report.warn_once("topic 0", "a mistake")
    assert capfd.readouterr().err.count("a mistake") == said


class _BrokenPipe(io.StringIO):
    def flush(self):
        raise BrokenPipeError


@pytest.mark.parametrize("state", ["none", "closed", "without a reader"])
def test_a_warning_that_cannot_be_written_ends_no_thread(monkeypatch, state):
    stream = None if state == "none" else _BrokenPipe()
    if state == "closed":
        stream.close()
    monkeypatch.setattr(sys, "stderr", stream)
    report.warn("nobody reads it")
    assert state != "without a reader" or "nobody reads it" in stream.getvalue()


def test_only_a_node_that_is_there_has_a_twin(monkeypatch, capfd):
    monkeypatch.setattr(report, "_said", set())
    nodes = NodeNames(7)

    def warnings():
        return capfd.readouterr().err.count("another process runs a node named /twin in domain 7")

    nodes.others(b"peer", ["/twin", "/other"], own=["/mine"])
    nodes.gone(b"peer")
    nodes.gone(b"never seen")
    nodes.own("/twin")
    nodes.others(b"peer", ["/twin"], own=[])
    nodes.others(b"peer", ["/renamed"], own=["/twin"])
    nodes.own("/twin")
    assert warnings() == 0
    nodes.others(b"peer", ["/twin"], own=[])
    nodes.own("/twin")
    assert warnings() == 1
