"""What verbs print of the text of other processes."""

from __future__ import annotations

import io
import sys

import pytest

from ros2cli.main import main
from ros2cli.output import escaped_output, tell

EVIL = "\x1b]0;owned\x07\x1b[2J"


def test_only_lines_and_tabs_reach_the_terminal(capsys):
    with escaped_output():
        print(f"a{EVIL}\n\tb\rc")
    assert capsys.readouterr().out == "a\\x1b]0;owned\\x07\\x1b[2J\n\tb\\rc\n"
    print("\x1b[1mbold")
    assert capsys.readouterr().out == "\x1b[1mbold\n"


def test_messages_on_stderr_are_escaped(capsys):
    tell(f"no node {EVIL}")
    assert "\x1b" not in capsys.readouterr().err


def test_a_reader_that_has_gone_stays_gone(monkeypatch):
    monkeypatch.setattr(sys, "stdout", None)
    with escaped_output():
        assert sys.stdout is None


@pytest.mark.parametrize("raised", [None, RuntimeError(f"Unknown topic '{EVIL}'")])
def test_every_verb_is_escaped(monkeypatch, capsys, raised):
    import ros2cli.commands.pkg.list as verb

    def fake(_args):
        print(f"/{EVIL}")
        if raised is not None:
            raise raised

    monkeypatch.setattr(verb, "main", fake)
    assert main(["pkg", "list"]) == (0 if raised is None else 1)
    told = capsys.readouterr()
    assert "\\x1b]0;owned" in told.out
    assert "\x1b" not in told.out + told.err


def test_topic_info_of_a_hostile_node(monkeypatch, capsys):
    """The wire takes no such name from us; a peer may announce any."""
    from ros2cli import graph
    from turtlewire.wire.base import EndpointInfo, NodeInfo
    from turtlewire.wire.qos import QoS

    node = NodeInfo(EVIL, "/", "/")
    end = EndpointInfo("publisher", "/x", "std_msgs/msg/String", "", node, bytes(16), QoS())
    monkeypatch.setattr(graph, "topics", lambda *_args, **_kw: [("/x", ["std_msgs/msg/String"])])
    monkeypatch.setattr(graph, "endpoints_of_topic", lambda *_args: [end])
    assert main(["topic", "info", "-v", "/x"]) == 0
    text = capsys.readouterr().out
    assert "Node name: \\x1b]0;owned\\x07\\x1b[2J\n" in text
    assert "\x1b" not in text


def test_characters_that_the_output_does_not_have_end_no_verb(monkeypatch):
    written = io.BytesIO()
    monkeypatch.setattr(sys, "stdout", io.TextIOWrapper(written, encoding="ascii"))
    words = ["topic", "pub", "--once", "-w", "0", "/names", "std_msgs/msg/String"]
    assert main([*words, "data: Köln 🐢"]) == 0
    sys.stdout.flush()
    assert rb"String(data='K\xf6ln \U0001f422')" in written.getvalue()
