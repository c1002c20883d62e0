from __future__ import annotations

import math
import subprocess
import sys
from xml.etree import ElementTree as ET

import pytest
from tests.programs import run_python

from tf2_ros import Buffer

QUARTER = (0.0, 0.0, math.sqrt(0.5), math.sqrt(0.5))
SVG = "{http://www.w3.org/2000/svg}"


@pytest.fixture
def filled(buffer):
    buffer.set_transform("world", "turtle1", 10**9, (3.0, 4.0, 0.0), QUARTER)
    return buffer


def test_a_buffer_shows_its_tree(filled):
    root = ET.fromstring(filled._repr_svg_())
    assert root.tag == f"{SVG}svg"
    assert {"world", "turtle1"} < {text.text for text in root.iter(f"{SVG}text")}


def test_a_large_tree_is_cut(buffer):
    for i in range(3000):
        buffer.set_transform(f"f{i}", f"f{i + 1}", 1, (0, 0, 0), (0, 0, 0, 1))
    texts = {text.text for text in ET.fromstring(buffer._repr_svg_()).iter(f"{SVG}text")}
    assert "3,001 frames, the first 501 of them shown" in texts
    assert {"f0", "f500"} < texts
    assert "f501" not in texts


def test_an_empty_buffer_says_so(buffer):
    assert "No tf data received" in buffer._repr_svg_()


def test_tf2_ros_buffers_show_theirs():
    buffer = Buffer()
    buffer.engine.set_transform("world", "turtle1", 10**9, (3.0, 4.0, 0.0), QUARTER)
    assert "turtle1" in buffer._repr_svg_()


def test_a_transform_shows_numbers_and_a_picture(filled):
    html = filled.lookup_transform("world", "turtle1")._repr_html_()
    root = ET.fromstring(html)
    cells = {row[0].text: row[1].text for row in root.iter("tr")}
    assert cells == {
        "x, y, z": "3.0000, 4.0000, 0.0000 m",
        "distance": "5.0000 m",
        "roll, pitch, yaw": "0.00, 0.00, 90.00 °",
        "quaternion x, y, z, w": "0.00000, 0.00000, 0.70711, 0.70711",
        "stamp": "1000000000 ns",
    }
    assert "".join(root.find("table/caption").itertext()) == "Where turtle1 is, seen from world"
    assert [text.text for text in root.iter(f"{SVG}text")] == ["world", "turtle1"]
    lines = [line.get("points") for line in root.iter(f"{SVG}polyline")]
    assert len(lines) == 7  # two frames of three axes, and the way from one to the other
    for point in " ".join(lines).split():
        assert all(0 <= float(value) <= 190 for value in point.split(","))


@pytest.mark.parametrize("translation", [(0.0, 0.0, 0.0), (1e-9, 0.0, 0.0), (1e9, -1e9, 1e9)])
def test_any_distance_fits(buffer, translation):
    buffer.set_static_transform("<map>", "a & b", translation, (0.0, 0.0, 0.0, 1.0))
    root = ET.fromstring(buffer.lookup_transform("<map>", "a & b")._repr_html_())
    labels = list(root.iter(f"{SVG}text"))
    assert [label.text for label in labels] == ["<map>", "a & b"]
    assert abs(float(labels[0].get("y")) - float(labels[1].get("y"))) > 10 or translation == (
        1e9,
        -1e9,
        1e9,
    )


def test_pictures_are_loaded_when_they_are_asked_for():
    program = (
        "import sys, turtlewire; turtlewire.Buffer(); print('turtlewire.tf.notebook' in "
        "sys.modules, 'numpy' in sys.modules)"
    )
    assert run_python(program).stdout.split() == ["False", "False"]


def test_a_message_shows_what_a_transform_shows_in_a_notebook_alone():
    program = """
import sys, types
if {notebook}:
    sys.modules["IPython"] = types.ModuleType("IPython")
from tf2_ros import Buffer
from rclpy.time import Time
buffer = Buffer()
buffer.engine.set_transform("world", "turtle1", 10**9, (3.0, 4.0, 0.0), (0.0, 0.0, 0.0, 1.0))
message = buffer.lookup_transform("world", "turtle1", Time())
if {notebook}:
    assert message._repr_html_() == buffer.engine.lookup_transform("world", "turtle1")._repr_html_()
    message.transform.rotation.w = 0.0
    assert message._repr_html_() is None
else:
    assert not hasattr(message, "_repr_html_")
"""
    for notebook in (True, False):
        subprocess.run([sys.executable, "-c", program.format(notebook=notebook)], check=True)


@pytest.mark.parametrize("translation", [(math.inf, 0.0, 0.0), (0.0, -math.inf, math.inf)])
def test_an_endless_distance_is_told_in_numbers(buffer, translation):
    """tf2 takes it, so a cell must show it."""
    buffer.set_static_transform("world", "robot", translation, (0.0, 0.0, 0.0, 1.0))
    html = buffer.lookup_transform("world", "robot")._repr_html_()
    assert "nan" in html or "inf" in html
    assert "<svg" not in html
