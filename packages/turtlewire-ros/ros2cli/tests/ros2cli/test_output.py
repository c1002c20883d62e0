"""The output of verbs with text of other processes."""

import io
import sys
from contextlib import nullcontext

import pytest

from ros2cli.main import main
from ros2cli.output import escaped_output, tell
from turtlewire.wire.base import EndpointInfo, ForeignServer, NodeInfo
from turtlewire.wire.qos import QoS

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
    import ros2pkg.verb.list as verb

    def fake(_args):
        print(f"/{EVIL}")
        if raised is not None:
            raise raised

    monkeypatch.setattr(verb, "main", fake)
    assert main(["pkg", "list"]) == (0 if raised is None else 1)
    told = capsys.readouterr()
    assert "\\x1b]0;owned" in told.out
    assert "\x1b" not in told.out + told.err


class HostileGraph:
    """The graph with a peer that announces names and types that ROS 2 would reject."""

    def __init__(self):
        node = NodeInfo(f"{EVIL}\nnode", "/", "/")
        ends = {
            "publisher": ["/x\nPublisher count: 9"],
            "subscription": ["/x\nPublisher count: 9", "rq/s\nrvRequest"],
        }
        self._endpoints = [
            EndpointInfo(kind, topic, "a/msg/T\n/forged", "", node, bytes(16), QoS())
            for kind, topics in ends.items()
            for topic in topics
        ]

    def nodes(self):
        return [end.node for end in self._endpoints[:1]]

    def endpoints(self):
        return self._endpoints

    def topic_names_and_types(self):
        return {"/x\nPublisher count: 9": ["a/msg/T\n/forged"]}

    def service_names_and_types(self):
        return {"/s\nrv": ["a/srv/T\n/forged"]}

    def foreign_servers(self):
        return [ForeignServer("/s\nrv", self.nodes()[0], "Fast DDS")]

    def is_complete(self):
        return True


def meet_hostile_peer(monkeypatch, command, verb):
    module = f"ros2{command}.verb.{verb}"
    monkeypatch.setattr(f"{module}.discovered_graph", lambda _: nullcontext(HostileGraph()))


@pytest.mark.parametrize(
    ("words", "lines"),
    [
        (["topic", "list", "-t"], [r"/x\nPublisher count: 9 [a/msg/T\n/forged]"]),
        (["service", "list", "-t"], [r"/s\nrv [a/srv/T\n/forged]"]),
        (["service", "type", r"/s\nrv"], [r"a/srv/T\n/forged"]),
        (["node", "list"], [r"/\x1b]0;owned\x07\x1b[2J\nnode"]),
    ],
)
def test_lists_beside_a_hostile_peer(monkeypatch, capsys, words, lines):
    meet_hostile_peer(monkeypatch, *words[:2])
    assert main(words) == 0
    assert capsys.readouterr().out.splitlines() == lines


def test_topic_info_of_a_hostile_peer(monkeypatch, capsys):
    meet_hostile_peer(monkeypatch, "topic", "info")
    assert main(["topic", "info", "-v", r"/x\nPublisher count: 9"]) == 0
    text = capsys.readouterr().out
    assert "Node name: \\x1b]0;owned\\x07\\x1b[2J\\nnode\n" in text
    assert text.count("\nTopic type: a/msg/T\\n/forged\n") == 2
    assert "\n/forged" not in text
    assert "\x1b" not in text


def test_node_info_of_a_hostile_peer(monkeypatch, capsys):
    meet_hostile_peer(monkeypatch, "node", "info")
    assert main(["node", "info", r"/\x1b]0;owned\x07\x1b[2J\nnode"]) == 0
    text, told = capsys.readouterr()
    assert "    /x\\nPublisher count: 9: a/msg/T\\n/forged\n" in text
    assert "    /s\\nrv: a/msg/T\\n/forged\n" in text
    assert told.startswith(r"The services of /\x1b]0;owned\x07\x1b[2J\nnode, including parameters")
    assert "it runs on Fast DDS. Start the node with RMW_IMPLEMENTATION=rmw_cyclonedds_cpp" in told


def test_characters_that_the_output_does_not_have_end_no_verb(monkeypatch):
    written = io.BytesIO()
    monkeypatch.setattr(sys, "stdout", io.TextIOWrapper(written, encoding="ascii"))
    words = ["topic", "pub", "--once", "-w", "0", "/names", "std_msgs/msg/String"]
    assert main([*words, "data: Köln 🐢"]) == 0
    sys.stdout.flush()
    assert rb"String(data='K\xf6ln \U0001f422')" in written.getvalue()
