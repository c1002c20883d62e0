"""`ros2 topic pub --yaml-file` with a subscription."""

import sys

import pytest

import rclpy
from geometry_msgs.msg import PointStamped
from ros2cli.main import main

ROS2 = (
    sys.executable,
    "-c",
    "import sys; from ros2cli.main import main; sys.exit(main(sys.argv[1:]))",
)
#: As `ros2 topic echo` prints it, with `---` after the last message.
DOCUMENTS = """\
header: {stamp: now, frame_id: a}
---
point: {x: 2.0}
---
point: {x: 3.0}
---
"""
UNKNOWN_FIELD = "'PointStamped' object has no attribute 'points'\nDid you mean: point"
KIND = "geometry_msgs/msg/PointStamped"


@pytest.fixture
def heard():
    """A function that waits for three messages on /points, at most for seconds."""
    with rclpy.init(args=[]):
        node, messages = rclpy.create_node("listener"), []
        done = rclpy.task.Future()

        def hear(message):
            messages.append(message)
            if len(messages) == 3:
                done.set_result(None)

        node.create_subscription(PointStamped, "points", hear, 10)

        def wait(seconds):
            rclpy.spin_until_future_complete(node, done, timeout_sec=seconds)
            return messages

        yield wait


def test_each_document_is_a_message(run, tmp_path, heard):
    (tmp_path / "points.yaml").write_text(DOCUMENTS)
    words = ("--yaml-file", tmp_path / "points.yaml", "-r", "50", "-w", "1")
    pub = run(*ROS2, "topic", "pub", "/points", KIND, *words)
    first, second, third = heard(60)
    assert pub.wait() == 0
    assert (first.header.frame_id, second.point.x, third.point.x) == ("a", 2.0, 3.0)
    assert first.header.stamp.sec > 0 == second.header.stamp.sec
    assert [line[:14] for line in pub.text.splitlines() if "publishing" in line] == [
        "publishing #1:",
        "publishing #2:",
        "publishing #3:",
    ]


@pytest.mark.parametrize(("option", "count"), [("--once", 1), ("-t2", 2), ("-t9", 3)])
def test_no_more_messages_than_asked_for(run, tmp_path, option, count):
    (tmp_path / "points.yaml").write_text(DOCUMENTS)
    words = ("--yaml-file", tmp_path / "points.yaml", "-r", "50", "-w", "0", option)
    pub = run(*ROS2, "topic", "pub", "/points", KIND, *words)
    assert pub.wait() == 0
    assert pub.text.count("publishing #") == count


@pytest.mark.parametrize(
    ("text", "told"),
    [
        (None, "Cannot read '{}': No such file or directory\n"),
        ("", "The file '{}' holds no YAML document\n"),
        ("point: {}\n---\n[1]", "The passed value needs to be a dictionary in YAML format\n"),
        ("point: {}\n---\npoints: {}", f"Failed to populate field: {UNKNOWN_FIELD}\n"),
    ],
    ids=["missing", "empty", "list", "field"],
)
def test_wrong_files_are_rejected_before_anything_is_sent(capsys, tmp_path, text, told):
    path = tmp_path / "points.yaml"
    if text is not None:
        path.write_text(text)
    assert main(["topic", "pub", "/points", KIND, "--yaml-file", str(path)]) == 1
    assert capsys.readouterr() == ("", told.format(path))


def test_values_and_a_file_exclude_each_other(capsys):
    with pytest.raises(SystemExit) as end:
        main(["topic", "pub", "/points", KIND, "{}", "--yaml-file", "points.yaml"])
    assert end.value.code == 2
    assert "argument --yaml-file: not allowed with argument values" in capsys.readouterr().err
