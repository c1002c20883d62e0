from __future__ import annotations

import shutil
import subprocess

import pytest
import yaml

from tf2_tools.dot import dot_from_tree
from tf2_tools.view_frames import generate_dot
from turtlewire import Buffer
from turtlewire.tf.frame_tree import FrameLink, FrameTree, read_frame_tree


def test_one_link_as_ros_2_writes_it():
    tree = FrameTree(
        [FrameLink("turtle1", "world", "default_authority", False, 62.7, 12.5, 7.25, 5.25)]
    )
    assert dot_from_tree(tree, "100.000000") == (
        "digraph G {\n"
        '"world" -> "turtle1"[label=" Broadcaster: default_authority\\n'
        "Average rate: 62.700\\nBuffer length: 5.250\\n"
        'Most recent transform: 12.500000\\nOldest transform: 7.250000\\n"];\n'
        "edge [style=invis];\n"
        ' subgraph cluster_legend { style=bold; color=black; label ="view_frames Result";\n'
        '"Recorded at time: 100.000000"[ shape=plaintext ] ;\n'
        '}->"world";\n'
        "}"
    )


def test_the_dot_of_the_frames_of_the_service():
    buffer = Buffer()
    buffer.set_transform("world", "turtle1", 7_250_000_000, (1, 2, 3), (0, 0, 0, 1))
    buffer.set_transform("world", "turtle1", 12_500_000_000, (1, 2, 3), (0, 0, 0, 1))
    data = yaml.safe_load(buffer.to_yaml())
    assert generate_dot(data, 100.0) == dot_from_tree(read_frame_tree(buffer), "100.0")
    assert generate_dot({}, 1.0) == 'digraph G { "No tf data received" }'


def test_no_data():
    assert dot_from_tree(FrameTree([]), "1.0") == 'digraph G { "No tf data received" }'


@pytest.mark.skipif(shutil.which("dot") is None, reason="needs dot (Debian: apt install graphviz)")
@pytest.mark.parametrize(
    "pairs", [[("a", "b"), ("b", "a")], [('say "hi"', "back\\slash"), ("x", "y")]]
)
def test_graphviz_takes_loops_and_quotes(pairs):
    tree = FrameTree(
        FrameLink(child, parent, "", False, 1.0, 2.0, 1.0, 1.0) for parent, child in pairs
    )
    run = subprocess.run(
        ["dot", "-Tplain"],
        input=dot_from_tree(tree, "1.0"),
        capture_output=True,
        text=True,
        check=True,
    )
    assert run.stderr == ""
    assert run.stdout.count("\nedge ") >= len(pairs)
