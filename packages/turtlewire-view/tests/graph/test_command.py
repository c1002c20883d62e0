"""`turtlewire graph`: its words, its files, its address and its end."""

import json
import signal
import socket
import sys
from xml.etree import ElementTree as ET

import pytest
from tests.disks import full_disk
from tests.places import BIN
from websockets.sync.client import connect

from turtlewire.cli.main import main
from turtlewire.doctor import network

TALKER = """
import threading
from turtlewire import msg, wire
from turtlewire.wire.base import TypeId
from turtlewire.wire.qos import QoS
name = "std_msgs/msg/String"
context = wire.open_context()
context.create_node("talker").create_publisher("/chatter", TypeId(name, msg.type_hash(name)), QoS())
print("ready", flush=True)
threading.Event().wait()
"""


@pytest.fixture
def graph(run):
    def start(*words, **options):
        return run(BIN / "turtlewire", "graph", *words, **options)

    return start


@pytest.fixture
def talker(run):
    program = run(sys.executable, "-c", TALKER)
    program.wait_for("ready")
    return program


def address_of(program):
    return program.wait_for(r"The graph is at http(://127\.0\.0\.1:\d+/)")[0][1]


def test_the_page_shows_another_process_and_ends_at_ctrl_c(graph, talker):
    program = graph("--port", "0", terminal=True)
    with connect(f"ws{address_of(program)}live", max_size=None) as page:
        messages = map(json.loads, page)
        assert next(messages)["type"] == "hello"
        talkers = [{"node": "/talker", "count": 1}]
        next(each for each in messages if each["type"] == "graph" and
             each["graph"]["nodes"] == talkers)  # fmt: skip
        talker.kill()
        program.type("\x03")
        assert program.wait() == 130
    assert "Traceback" not in program.text


def test_the_options_are_what_the_page_shows_first(graph):
    program = graph("--port", "0", "--topics", "none", "--debug", "--filter=-tf")
    with connect(f"ws{address_of(program)}live", max_size=None) as page:
        hello = json.loads(page.recv())
    assert hello["selection"] == {"topics": "none", "debug": True, "words": "-tf"}
    program.process.send_signal(signal.SIGTERM)
    assert program.wait() == 0


def test_a_port_in_use_is_said(graph):
    with socket.create_server(("127.0.0.1", 0)) as server:
        port = server.getsockname()[1]
        program = graph("--port", str(port))
        assert not address_of(program).endswith(f":{port}/")
        program.process.send_signal(signal.SIGTERM)
        assert program.wait() == 0
    assert program.text.startswith(f"Port {port} is in use: the graph uses a free port\n")


@pytest.mark.parametrize("suffix", ["svg", "dot", "json"])
def test_the_graph_is_saved(graph, talker, tmp_path, suffix):
    path = tmp_path / f"graph.{suffix}"
    program = graph("--save", path)
    assert program.wait() == 0
    assert program.text == f"Wrote {path}: nodes 1, topics 1, mismatches 0"
    text = path.read_text(encoding="utf-8")
    assert "/talker" in text
    assert "/chatter" in text
    if suffix == "json":
        assert json.loads(text)["nodes"] == [{"node": "/talker", "count": 1}]
    if suffix == "svg":
        assert ET.fromstring(text).tag.endswith("svg")


def test_an_empty_domain_is_said_if_others_have_nodes(monkeypatch, capsys, tmp_path):
    monkeypatch.setattr(network, "other_domains", lambda domain: [3, 5, 9])
    assert main(["graph", "--save", str(tmp_path / "graph.json")]) == 0
    said = capsys.readouterr()
    assert said.out.endswith("graph.json: nodes 0, topics 0, mismatches 0\n")
    assert said.err.endswith(
        "This computer has nodes on domains 3, 5 and 9: export ROS_DOMAIN_ID=3\n"
    )


def test_a_full_disk_is_reported_and_leaves_the_older_file(capsys, tmp_path):
    path = tmp_path / "graph.svg"
    path.write_text("older")
    with full_disk():
        assert main(["graph", "--save", str(path)]) == 2
    assert capsys.readouterr().err.endswith(f": {path}: File too large\n")
    assert path.read_text() == "older"


def test_a_wrong_suffix_is_refused_before_the_network_is_joined(graph, tmp_path):
    program = graph("--save", tmp_path / "graph.png", environment={"ROS_DOMAIN_ID": "9999"})
    assert program.wait() == 2
    assert program.text == (
        f"turtlewire graph: {tmp_path}/graph.png does not end in .svg, .dot or .json: the graph is "
        "written as these"
    )


def test_a_file_that_cannot_be_written_is_named(graph, tmp_path):
    program = graph("--save", tmp_path / "missing" / "graph.svg")
    assert program.wait() == 2
    assert program.text.startswith("turtlewire graph: ")
    assert f"{tmp_path}/missing/graph.svg" in program.text


def test_a_network_that_cannot_be_joined_is_one_line(graph):
    program = graph("--port", "0", environment={"ROS_DOMAIN_ID": "9999"})
    assert program.wait() == 2
    assert program.text.startswith("turtlewire graph: ")
    assert len(program.text.splitlines()) == 1
