import itertools
import math
import subprocess
import sys
from xml.etree import ElementTree as ET

import numpy as np
import pytest
import yaml
from hypothesis import given
from hypothesis import strategies as st
from tests.programs import run_python

from tf2_ros import Buffer
from turtlewire.tf.drawing import Drawing, FilledBox, Line, Text, svg_from_drawing, text_width
from turtlewire.tf.frame_tree import FrameLink, FrameTree, read_frame_tree
from turtlewire.tf.tree_drawing import draw_tree, tidy_positions

SVG = "{http://www.w3.org/2000/svg}"


def tree_of(*pairs, static=False, newest=2.0, oldest=1.0):
    return FrameTree(
        FrameLink(child, parent, "someone", static, 62.5, newest, oldest, newest - oldest)
        for parent, child in pairs
    )


def texts(drawing):
    return [shape.text for shape in drawing.shapes if isinstance(shape, Text)]


def boxes(drawing):
    return [shape for shape in drawing.shapes if isinstance(shape, FilledBox)]


def test_a_card_has_what_view_frames_shows():
    assert texts(draw_tree(tree_of(("world", "turtle1")), ("Title",))) == [
        "Title",
        "world",
        "turtle1",
        "Broadcaster: someone",
        "Average rate: 62.500 Hz",
        "Buffer length: 1.000 s",
        "Most recent transform: 2.000000",
        "Oldest transform: 1.000000",
    ]


def test_a_card_holds_its_text_in_a_browser_without_helvetica():
    drawing = draw_tree(tree_of(("world", "turtle1")))
    (note,) = (
        shape
        for shape in drawing.shapes
        if isinstance(shape, Text) and shape.text == "Most recent transform: 2.000000"
    )
    card = max(boxes(drawing), key=lambda box: box.width)
    dejavu_sans = 140.7  # its width in that font, as measured
    assert card.x < note.x < note.x + dejavu_sans <= card.x + card.width - 5.0


def test_a_static_transform_has_no_rate_and_a_single_one_neither():
    assert texts(draw_tree(tree_of(("a", "b"), static=True)))[1:] == [
        "b",
        "Broadcaster: someone",
        "Static transform",
    ]
    assert "Average rate: unknown, one time only" in texts(
        draw_tree(tree_of(("a", "b"), newest=5.0, oldest=5.0))
    )


def test_no_data_is_said():
    drawing = draw_tree(FrameTree([]))
    assert texts(drawing) == ["No tf data received"]
    assert drawing.width > 60
    assert drawing.height > 15


def test_a_loop_is_told_and_drawn_in_red():
    drawing = draw_tree(tree_of(("b", "a"), ("a", "b")))
    assert "In a loop: its parent is b" in texts(drawing)
    assert [line.dashed for line in drawing.shapes if isinstance(line, Line)] == [False, True]


@pytest.mark.parametrize("count", [1, 3, 40])
def test_everything_is_on_the_page_and_no_card_covers_another(count):
    pairs = [("base", f"sensor{i}") for i in range(count)] + [
        (f"sensor{i}", f"optical{i}") for i in range(0, count, 3)
    ]
    drawing = draw_tree(tree_of(*pairs), ("Title",))
    cards = boxes(drawing)
    assert len(cards) == len(pairs) + 1
    for card in cards:
        assert 0 <= card.x < card.x + card.width <= drawing.width
        assert 0 <= card.y < card.y + card.height <= drawing.height
        for other in cards:
            apart = card.x + card.width < other.x or other.x + other.width < card.x
            apart = apart or card.y + card.height < other.y or other.y + other.height < card.y
            assert other is card or apart
    # Lines lead from the end of a card to the start of another one, and never back.
    beside = {(card.x + card.width, card.y + card.height / 2) for card in cards}
    below = {(card.x + card.width / 2, card.y + card.height) for card in cards}
    before = {(card.x, card.y + card.height / 2) for card in cards}
    above = {(card.x + card.width / 2, card.y) for card in cards}
    lines = [shape.points for shape in drawing.shapes if isinstance(shape, Line)]
    assert len(lines) == len(pairs)
    for points in lines:
        sideways = points[0][1] == points[1][1]
        assert points[0] in (beside if sideways else below)
        assert points[-1] in (before if sideways else above)
        assert sorted(points, key=lambda point: point[0 if sideways else 1]) == list(points)
    for text in texts(drawing):
        assert text_width(text, 1.0) > 0
    assert drawing.width < 1300  # a wide tree grows to the right, so that it can still be read


def test_svg_is_xml_whatever_the_frames_are_called():
    names = ("<b>&\"'", "bell\x07", "日本", "x" * 500)
    root = ET.fromstring(svg_from_drawing(draw_tree(tree_of(*[("base", name) for name in names]))))
    shown = [element.text for element in root.iter(f"{SVG}text")]
    assert {"<b>&\"'", "bell\N{REPLACEMENT CHARACTER}", "日本", "x" * 59 + "…"} < set(shown)
    assert len(list(root.iter(f"{SVG}rect"))) == 5


def test_svg_of_each_shape():
    shapes = (
        FilledBox(1, 2, 3, 4, "#111111"),
        Line(((0, 0), (5, 6)), "#222222", 2.0, dashed=True),
        Line(((0, 0), (5, 6)), "#222222"),
        Text(7, 8, "hi", 9, "#333333", bold=True),
    )
    root = ET.fromstring(svg_from_drawing(Drawing(100, 50, shapes)))
    assert root.get("viewBox") == "0 0 100 50"
    rect, line, solid, text = root
    assert (rect.get("x"), rect.get("height"), rect.get("stroke")) == ("1.0", "4.0", "#111111")
    assert (line.get("points"), line.get("stroke-dasharray")) == ("0.0,0.0 5.0,6.0", "5 3")
    assert solid.get("stroke-dasharray") is None
    assert (text.text, text.get("font-weight"), text.get("font-size")) == ("hi", "bold", "9")


def test_widths_are_helveticas():
    assert text_width("Wi ~", 1000) == 944 + 222 + 278 + 584
    assert text_width("日", 10) == 10
    assert text_width("a", 10, bold=True) > text_width("a", 10)


# The layout without crossings.


@st.composite
def forests(draw):
    """Each node hangs on an earlier one, or on none."""
    names = [f"n{i}" for i in range(draw(st.integers(1, 30)))]
    children, roots = {name: [] for name in names}, []
    for i, name in enumerate(names):
        parent = draw(st.integers(-1, i - 1))
        (roots if parent < 0 else children[names[parent]]).append(name)
    return roots, children, {name: draw(st.floats(1, 100)) for name in names}


@given(forests(), st.floats(0, 20))
def test_rows_keep_order_and_parents_are_centred(forest, gap):
    roots, children, sizes = forest
    positions = tidy_positions(roots, children, sizes, gap)
    assert positions.keys() == sizes.keys()
    rows = {}
    for name, (place, row) in positions.items():
        rows.setdefault(row, []).append((place - sizes[name] / 2, place + sizes[name] / 2))
    for row in rows.values():
        row.sort()
        assert all(right + gap <= left + 1e-6 for (_, right), (left, _) in itertools.pairwise(row))
    assert min(left for row in rows.values() for left, _ in row) == pytest.approx(0.0, abs=1e-6)
    for parent, below in children.items():
        places = [positions[child][0] for child in below]
        assert places == sorted(places)
        assert all(positions[child][1] == positions[parent][1] + 1 for child in below)
        if below:
            assert positions[parent][0] == pytest.approx((places[0] + places[-1]) / 2)


def test_by_hand():
    positions = tidy_positions(
        ["a"],
        {"a": ["b", "c"], "b": [], "c": ["d"], "d": []},
        {"a": 10, "b": 20, "c": 20, "d": 60},
        4,
    )
    assert positions == {"b": (10.0, 1), "c": (34.0, 1), "a": (22.0, 0), "d": (34.0, 2)}


def test_a_chain_may_be_longer_than_pythons_stack():
    names = [f"n{i}" for i in range(3000)]
    children = {name: [below] for name, below in itertools.pairwise(names)} | {names[-1]: []}
    positions = tidy_positions(names[:1], children, dict.fromkeys(names, 10.0), 4)
    assert positions[names[-1]] == (5.0, 2999)


def test_nothing():
    assert tidy_positions([], {}, {}, 4) == {}


# The tree without a picture.


IDENTITY = (0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 1.0)


def test_figures_of_a_buffer(buffer):
    for second in (1, 2, 3):
        buffer.set_transform("map", "base", second * 10**9, *IDENTITY, sender="robot")
    buffer.set_static_transform("base", "laser", *IDENTITY, sender="urdf")
    tree = read_frame_tree(buffer)
    assert tree.links["base"] == FrameLink("base", "map", "robot", False, 1.5, 3.0, 1.0, 2.0)
    assert tree.links["laser"] == FrameLink("laser", "base", "urdf", True, 10_000.0, 0.0, 0.0, 0.0)
    assert (tree.roots, tree.loops) == (["map"], [])
    assert tree.children == {"map": ["base"], "base": ["laser"], "laser": []}


def test_an_empty_buffer(buffer):
    tree = read_frame_tree(buffer)
    assert (tree.links, tree.roots, tree.children, tree.loops) == ({}, [], {}, [])


def test_figures_are_those_of_tf2s_yaml(buffer):
    buffer.set_transform("map", "base", 10**9, *IDENTITY, sender="robot")
    buffer.set_transform("map", "base", 3 * 10**9, *IDENTITY, sender="another")
    buffer.set_static_transform("base", "laser", *IDENTITY)
    described = yaml.safe_load(buffer.to_yaml())
    links = read_frame_tree(buffer).links
    assert described.keys() == links.keys()
    for child, link in links.items():
        assert described[child] == {
            "parent": link.parent,
            "broadcaster": link.broadcaster,
            "rate": link.rate_hz,
            "most_recent_transform": link.newest,
            "oldest_transform": link.oldest,
            "buffer_length": link.length,
        }


def test_links_whose_samples_are_forgotten_are_left_out(buffer):
    buffer.set_transform("map", "base", 10**9, *IDENTITY)
    buffer.set_static_transform("map", "fixed", *IDENTITY)
    buffer.clear()
    assert list(read_frame_tree(buffer).links) == ["fixed"]


@pytest.mark.parametrize("name", ["a: b", "it's", "- x", "a\nb", "{}", "日本", "'", "null"])
def test_names_that_yaml_would_not_take(buffer, name):
    buffer.set_transform("map", name, 10**9, *IDENTITY)
    buffer.set_transform(name, "next", 10**9, *IDENTITY)
    assert list(read_frame_tree(buffer).children) == ["map", name, "next"]


def test_a_loop_is_cut_before_its_first_frame():
    tree = tree_of(("c", "a"), ("a", "b"), ("b", "c"), ("b", "leaf"), ("world", "robot"))
    assert tree.loops == [["a", "c", "b"]]
    assert tree.roots == ["world", "a"]
    assert tree.children["a"] == ["b"]
    assert tree.children["c"] == []
    assert tree.children["b"] == ["c", "leaf"]


def test_several_loops_and_what_hangs_on_them():
    tree = tree_of(("x", "hanger"), ("y", "x"), ("x", "y"), ("q", "p"), ("p", "q"))
    assert [set(loop) for loop in tree.loops] == [{"x", "y"}, {"p", "q"}]
    reached, waiting = set(), list(tree.roots)
    while waiting:
        frame = waiting.pop()
        assert frame not in reached
        reached.add(frame)
        waiting.extend(tree.children[frame])
    assert reached == {"hanger", "x", "y", "p", "q"}


QUARTER = (0.0, 0.0, math.sqrt(0.5), math.sqrt(0.5))


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
    ends = np.array([[point.split(",") for point in line.split()] for line in lines], float)
    assert ((ends >= 0) & (ends <= 190)).all()
    way, axes = ends[0], ends[1:]
    assert way == pytest.approx(axes[[0, 3], 0], abs=0.1)
    x, y, z, source_x, source_y, source_z = axes[:, 1] - axes[:, 0]
    assert np.array([source_x, source_y, source_z]) == pytest.approx(np.array([y, -x, z]), abs=0.3)
    assert way[1] - way[0] == pytest.approx((3 * x + 4 * y) / (0.4 * 5), abs=0.5)


@pytest.mark.parametrize("translation", [(0.0, 0.0, 0.0), (1e-9, 0.0, 0.0), (1e9, -1e9, 1e9)])
def test_any_distance_fits(buffer, translation):
    name = f"a & {'b' * 30}"
    buffer.set_static_transform("<map>", name, translation, (0.0, 0.0, 0.0, 1.0))
    root = ET.fromstring(buffer.lookup_transform("<map>", name)._repr_html_())
    labels = list(root.iter(f"{SVG}text"))
    assert [label.text for label in labels] == ["<map>", f"a & {'b' * 19}…"]
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
