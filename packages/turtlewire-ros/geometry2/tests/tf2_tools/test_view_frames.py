"""view_frames as a separate process over DDS, and as a node in this one; its PDF."""

import json
import re
import shutil
import signal
import subprocess
import sys
import threading
import zlib
from xml.etree import ElementTree as ET

import pytest
import yaml
from tests.disks import full_disk

import rclpy
from geometry_msgs.msg import TransformStamped
from rclpy.context import Context
from rclpy.node import Node
from tf2_ros import StaticTransformBroadcaster, TransformBroadcaster
from tf2_tools.pdf import pdf_from_drawing
from tf2_tools.view_frames import ViewFrames, dot_from_tree, generate_dot
from turtlewire import Buffer
from turtlewire.tf.drawing import Drawing, FilledBox, Line, Text
from turtlewire.tf.frame_tree import FrameLink, FrameTree, read_frame_tree

COMMAND = [sys.executable, "-m", "tf2_tools.view_frames"]


def view_frames(*args, cwd):
    return subprocess.run(
        [*COMMAND, *args], cwd=cwd, capture_output=True, text=True, check=False, timeout=840
    )


def stamped(parent, child):
    transform = TransformStamped(child_frame_id=child)
    transform.header.frame_id = parent
    transform.header.stamp = rclpy.clock.Clock().now().to_msg()
    return transform


@pytest.fixture(scope="module")
def broadcaster():
    """A node of this process sends map -> base 50 times a second, and base -> laser once."""
    context = Context()
    context.init(args=[])
    node, stop = Node("robot", context=context), threading.Event()
    moving, fixed = TransformBroadcaster(node), StaticTransformBroadcaster(node)
    fixed.sendTransform(stamped("base", "laser"))

    def send():
        while not stop.wait(0.02):
            moving.sendTransform(stamped("map", "base"))

    thread = threading.Thread(target=send)
    thread.start()
    yield
    stop.set()
    thread.join()
    node.destroy_node()
    context.try_shutdown()


def until_all_is_heard(broadcaster_heard, *args, cwd):
    """Run it, and again for a longer time as long as a busy machine had too little of it."""
    for wait_time in (1, 4, 16, 60):
        run = view_frames("-t", str(wait_time), *args, cwd=cwd)
        if broadcaster_heard(run):
            return run
    return run


def test_it_listens_and_writes_three_files(broadcaster, tmp_path):
    run = until_all_is_heard(
        lambda run: "Received 3 frames" in run.stderr, "-o", "robot", cwd=tmp_path
    )
    assert run.returncode == 0, run.stderr
    said = [line.split("]: ", 1)[1] for line in (run.stdout + run.stderr).splitlines()]
    assert said[0].startswith("Listening to tf data for ")
    assert said[1:] == [
        "Received 3 frames, 2 of them with a parent",
        *[f"Wrote {tmp_path.resolve() / f'robot.{ending}'}" for ending in ("gv", "pdf", "svg")],
    ]
    assert sorted(path.name for path in tmp_path.iterdir()) == [
        "robot.gv",
        "robot.pdf",
        "robot.svg",
    ]
    dot = (tmp_path / "robot.gv").read_text()
    assert '"map" -> "base"[label=" Broadcaster: ' in dot
    assert '"base" -> "laser"[label=" Broadcaster: ' in dot
    assert (tmp_path / "robot.pdf").read_bytes().startswith(b"%PDF-1.4\n")
    shown = [
        text.text
        for text in ET.parse(tmp_path / "robot.svg")
        .getroot()
        .iter("{http://www.w3.org/2000/svg}text")
    ]
    assert shown[0] == "view_frames Result"
    assert {"map", "base", "laser", "Static transform"} < set(shown)


def test_json(broadcaster, tmp_path):
    run = until_all_is_heard(
        lambda run: "laser" in run.stdout and '"map"' in run.stdout, "--json", cwd=tmp_path
    )
    links = {link["child"]: link for link in json.loads(run.stdout)}
    assert {child: link["parent"] for child, link in links.items()} == {
        "base": "map",
        "laser": "base",
    }
    assert links["base"]["rate_hz"] > 1
    assert list(tmp_path.iterdir()) == []


def test_hearing_nothing_is_said_and_drawn(broadcaster, tmp_path):
    topics = "--tf_topic other --tf_static_topic /other_static --ros-args -r __ns:=/x"
    run = view_frames("-t", "0", *topics.split(), cwd=tmp_path)
    assert run.returncode == 0
    assert (
        "No tf data received on /x/other and /other_static. Is a broadcaster running"
        in run.stdout + run.stderr
    )
    names = sorted(path.name for path in tmp_path.iterdir())
    assert [name.rpartition(".")[2] for name in names] == ["gv", "pdf", "svg"]
    assert all(name.startswith("frames_20") for name in names)
    (dot,) = tmp_path.glob("*.gv")
    assert dot.read_text() == 'digraph G { "No tf data received" }'
    (svg,) = tmp_path.glob("*.svg")
    assert "No tf data received" in svg.read_text()


def test_ctrl_c_ends_it_without_files(tmp_path):
    with subprocess.Popen(
        [*COMMAND, "-t", "600"],
        cwd=tmp_path,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    ) as process:
        assert "Listening to tf data for 600.0 seconds..." in process.stdout.readline()
        process.send_signal(signal.SIGINT)
        rest = process.stdout.read()
        assert process.wait(60) == 130
    assert "Traceback" not in rest
    assert list(tmp_path.iterdir()) == []


def test_files_that_cannot_be_written(tmp_path):
    run = view_frames("-t", "0", "-o", "no/such/folder/frames", cwd=tmp_path)
    assert run.returncode == 1
    assert (
        "Cannot write no/such/folder/frames.gv: No such file or directory"
        in run.stdout + run.stderr
    )


@pytest.mark.parametrize("wrong", ["soon", "-1", "inf", "nan"])
def test_no_time_to_wait(wrong, tmp_path):
    run = view_frames(f"--wait-time={wrong}", cwd=tmp_path)
    assert run.returncode == 2
    assert f"argument -t/--wait-time: '{wrong}' is not a number of seconds" in run.stderr


def test_a_topic_that_is_none(tmp_path):
    run = view_frames("-t", "0", "--tf_topic", "no topic", cwd=tmp_path)
    assert run.returncode == 1
    assert "Invalid topic name" in run.stderr
    assert "Traceback" not in run.stderr


def test_a_loop_is_told_and_written(monkeypatch, tmp_path, capfd):
    monkeypatch.setenv("RMW_IMPLEMENTATION", "local")
    rclpy.init(args=[])
    try:
        with ViewFrames() as node:
            for parent, child in (("a", "b"), ("b", "a")):
                node._buffer.set_transform(stamped(parent, child), "test")
            tree = node.listen(0.0)
            node.write(tree, str(tmp_path / "loop"))
    finally:
        rclpy.try_shutdown()
    assert (
        "These frames form a loop, no lookup across it works: b -> a -> b" in capfd.readouterr().err
    )
    assert isinstance(tree, FrameTree)
    assert isinstance(tree.links["a"], FrameLink)
    assert '"a" -> "b"' in (tmp_path / "loop.gv").read_text()
    assert len(list(tmp_path.iterdir())) == 3


def test_a_full_disk_leaves_the_older_file(monkeypatch, tmp_path):
    monkeypatch.setenv("RMW_IMPLEMENTATION", "local")
    path = tmp_path / "frames.gv"
    path.write_text("older")
    rclpy.init(args=[])
    try:
        with ViewFrames() as node, full_disk(), pytest.raises(OSError, match="too large"):
            node.write(FrameTree([]), str(tmp_path / "frames"))
    finally:
        rclpy.try_shutdown()
    assert path.read_text() == "older"


# The drawn trees.


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


DRAWING = Drawing(
    300.0,
    200.0,
    (
        FilledBox(10, 20, 30, 40, "#ff0000"),
        Line(((0, 0), (100, 0), (100, 50)), "#00ff00", 2.0, dashed=True),
        Text(10, 100, "naïve (…) \\ 猫", 12, "#0000ff", bold=True),
        Text(10, 150, "plain", 9, "#000000"),
    ),
)


def objects(data):
    """Bodies of the objects, found by way of the cross-reference table as a reader does."""
    start = int(re.search(rb"startxref\n(\d+)\n%%EOF\n$", data).group(1))
    table = data[start:]
    count = int(re.match(rb"xref\n0 (\d+)\n", table).group(1))
    entries = re.findall(rb"(\d{10}) (\d{5}) ([nf]) \n", table)
    assert len(entries) == count
    assert entries[0] == (b"0000000000", b"65535", b"f")
    assert re.search(rb"trailer\n<< /Size (\d+) /Root 1 0 R >>", table).group(1) == b"%d" % count
    found = {}
    for number, (offset, _, _) in enumerate(entries[1:], 1):
        body = data[int(offset) :]
        assert body.startswith(b"%d 0 obj\n" % number)
        found[number] = body[: body.index(b"\nendobj")].split(b"obj\n", 1)[1]
    return found


def content(data):
    stream = objects(data)[4]
    length = int(re.search(rb"/Length (\d+)", stream).group(1))
    body = stream.split(b"stream\n", 1)[1]
    assert body[length:] == b"\nendstream"
    return zlib.decompress(body[:length]).decode("ascii")


def test_the_file_is_what_a_reader_expects():
    data = pdf_from_drawing(DRAWING)
    assert data.startswith(b"%PDF-1.4\n")
    found = objects(data)
    assert found[1] == b"<< /Type /Catalog /Pages 2 0 R >>"
    assert b"/MediaBox [0 0 300.00 200.00]" in found[3]
    assert b"/BaseFont /Helvetica-Bold" in found[6]


def test_shapes_stand_where_they_should_with_y_upwards():
    lines = content(pdf_from_drawing(DRAWING)).splitlines()
    assert lines[1] == "1 1 1 rg 1.000 0.000 0.000 RG 1 w 10.00 140.00 30.00 40.00 re B"
    assert (
        lines[2]
        == "0.000 1.000 0.000 RG 2 w [5 3] 0 d 0.00 200.00 m 100.00 200.00 l 100.00 150.00 l S "
        "[] 0 d"
    )
    assert lines[4].startswith("BT 0.000 0.000 0.000 rg /F1 9 Tf 10.00 50.00 Td <")


def test_letters_that_the_fonts_lack_are_escaped():
    (shown,) = re.findall(r"/F2 .*<([0-9a-f]+)> Tj", content(pdf_from_drawing(DRAWING)))
    assert bytes.fromhex(shown).decode("cp1252") == "naïve (…) \\ \\u732b"


def test_pages_larger_than_pdf_allows_are_scaled():
    data = pdf_from_drawing(Drawing(28_800.0, 100.0, (Text(1, 2, "x", 9, "#000000"),)))
    assert b"/MediaBox [0 0 14400.00 50.00]" in objects(data)[3]
    assert content(data).startswith("0.500000 0 0 0.500000 0 0 cm\n")


@pytest.mark.skipif(
    shutil.which("pdftotext") is None, reason="needs pdftotext (Debian: apt install poppler-utils)"
)
def test_poppler_reads_it(tmp_path):
    (tmp_path / "x.pdf").write_bytes(pdf_from_drawing(DRAWING))
    run = subprocess.run(
        ["pdftotext", "x.pdf", "-"], cwd=tmp_path, capture_output=True, text=True, check=True
    )
    assert run.stderr == ""
    assert run.stdout.split() == ["naïve", "(…)", "\\", "\\u732b", "plain"]
