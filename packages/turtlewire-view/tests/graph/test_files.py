"""The graph as SVG, Graphviz and JSON.

docs/how-to/graph.md does what it says.
"""

import json
import os
import re
import subprocess
from xml.etree import ElementTree as ET

import pytest
from tests.places import BIN, HOW_TO, PATH

from turtlewire.wire.qos import INFINITE_NS, QoS
from turtlewire_view.graph.files import as_data, as_dot, as_json, as_svg, writer_for
from turtlewire_view.graph.picture import Selection

from .conftest import STRING, KnownGraph, large, robot

SVG = "{http://www.w3.org/2000/svg}"
RED = "#c2334d"


def svg_of(graph, *words):
    return ET.fromstring(as_svg(graph.picture(), Selection(*words)))


def test_the_picture_shows_mismatches_in_red_with_their_policy():
    root = svg_of(robot())
    red = [path.findtext(f"{SVG}title") for path in root.iter(f"{SVG}path")
           if path.get("stroke") == RED]  # fmt: skip
    assert len(red) == 6
    assert "/scan; it requests RELIABLE, but the publisher offers BEST_EFFORT" in red
    texts = [text.text for text in root.iter(f"{SVG}text")]
    assert {"/lidar", "/scan", "/cmd_vel (!)"} <= {*texts}
    policies = [text.text for text in root.iter(f"{SVG}text") if text.get("fill") == RED]
    assert sorted(policies) == ["durability", "reliability", "type"]


def test_the_picture_without_topics_shows_policies_on_its_arrows():
    root = svg_of(robot(), "none")
    texts = {text.text for text in root.iter(f"{SVG}text")}
    assert {"/lidar", "/slam", "reliability"} <= texts
    assert "/scan" not in texts


def test_a_picture_of_300_nodes_names_all_of_them():
    texts = {text.text for text in svg_of(large(300)).iter(f"{SVG}text")}
    assert {f"/robot{n % 10}/node_{n}" for n in range(300)} <= texts


def test_names_cannot_break_the_picture():
    graph = KnownGraph().node('/a<b>&"c', ["/t"])
    texts = [text.text for text in svg_of(graph).iter(f"{SVG}text")]
    assert '/a<b>&"c' in texts
    assert r'label="/a<b>&\"c"' in as_dot(graph.picture(), Selection())


def test_graphviz_gets_nodes_topics_and_red_arrows():
    lines = as_dot(robot().picture(), Selection()).splitlines()
    assert lines[0] == "digraph graph_of_nodes {"
    assert lines[-1] == "}"
    names = {line.split('"')[1]: line.split()[0] for line in lines if "shape=" in line}
    node, topic = names["/lidar"], names["/scan"]
    assert f'  {node} [label="/lidar", shape=ellipse];' in lines
    assert f'  {topic} [label="/scan", shape=box];' in lines
    bad = f'  {node} -> {topic} [label="reliability", color=red, fontcolor=red];'
    assert bad in lines


def test_graphviz_without_topics_writes_them_on_the_arrows():
    text = as_dot(robot().picture(), Selection("none"))
    assert r'[label="/scan\nreliability", color=red, fontcolor=red];' in text
    assert "shape=box" not in text


def test_json_holds_the_documented_keys():
    graph = KnownGraph().node("/lidar", [("/scan", QoS(depth=3, lifespan_ns=INFINITE_NS), STRING)])
    graph.add("subscription", "/scan", STRING, None)
    assert json.loads(as_json(graph.picture(), Selection())) == {
        "version": 1,
        "domain_id": 7,
        "nodes": [{"node": "/lidar", "count": 1}],
        "topics": [{"topic": "/scan", "types": [STRING]}],
        "endpoints": [
            {
                "kind": kind,
                "topic": "/scan",
                "node": node,
                "type": STRING,
                "qos": {
                    "reliability": "reliable",
                    "history": "keep_last",
                    "depth": depth,
                    "durability": "volatile",
                    "lifespan_ns": lifespan,
                    "deadline_ns": 0,
                    "liveliness": "system_default",
                    "liveliness_lease_duration_ns": 0,
                },
            }
            for kind, node, depth, lifespan in [
                ("subscription", None, 10, 0),
                ("publisher", "/lidar", 3, None),
            ]
        ],
        "mismatches": [],
    }


def test_json_holds_mismatches():
    data = json.loads(as_json(robot().picture(), Selection()))
    assert data["mismatches"][-1] == {
        "topic": "/scan",
        "policy": "reliability",
        "reason": "it requests RELIABLE, but the publisher offers BEST_EFFORT",
        "publishers": ["/lidar"],
        "subscriptions": ["/slam"],
    }


@pytest.mark.parametrize("name", ["graph.SVG", "a.b.dot", "graph.json"])
def test_the_suffix_chooses_the_format(name):
    assert writer_for(name)(robot().picture(), Selection())


@pytest.mark.parametrize("name", ["graph.png", "graph", "svg"])
def test_other_suffixes_are_refused_with_those_that_work(name):
    expected = f"^{name} does not end in .svg, .dot or .json: the graph is written as these$"
    with pytest.raises(ValueError, match=expected):
        writer_for(name)


PAGE = (HOW_TO / "graph.md").read_text(encoding="utf-8")


def test_the_search_words_stand_in_the_first_line():
    assert "rqt_graph without ROS" in PAGE.splitlines()[0]


def test_the_commands_print_what_the_page_says(run, tmp_path):
    examples = re.findall(r"```sh\n(.*?)```\n\n```text\n(.*?)```", PAGE, re.DOTALL)
    assert len(examples) == 2
    environment = {**os.environ, "PATH": PATH}
    for commands, expected in examples:
        said = ""
        for line in commands.splitlines():
            if line.endswith("&"):
                run(*[BIN / "ros2", *line.split()[1:-1]]).wait_for("Spawning turtle")
                continue
            said += subprocess.run(
                line, shell=True, check=True, capture_output=True, text=True, cwd=tmp_path,
                env=environment,
            ).stdout  # fmt: skip
        assert said == expected


def test_the_keys_are_those_of_the_file():
    data = json.loads(json.dumps(as_data(robot().picture(), Selection())))
    rows = re.findall(r"^\| `(\w+)` \| (.*) \|$", PAGE.partition("| key |")[2], re.MULTILINE)
    assert [name for name, _ in rows] == [*data]
    for name, text in rows:
        if isinstance(data[name], list):
            assert [key for key in data[name][0] if f"`{key}`" not in text] == []
