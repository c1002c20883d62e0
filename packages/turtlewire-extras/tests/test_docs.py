"""The examples of docs/how-to/extras.md, run."""

import doctest
import re
import signal
import sys

import pytest
from tests.how_to import blocks_of
from tests.places import HOW_TO, ROS2

from turtlewire.package_sources import source_hint

PAGE = (HOW_TO / "extras.md").read_text()


def test_the_images_are_as_shown():
    failed, tried = doctest.testfile(str(HOW_TO / "extras.md"), module_relative=False)
    assert (failed, tried) == (0, 7)


def test_the_diagnostics_arrive(run):
    node = run(sys.executable, "-c", blocks_of(PAGE, "python")[0])
    words = ("--once", "/diagnostics", "diagnostic_msgs/msg/DiagnosticArray")
    echo = run(ROS2, "topic", "echo", *words)
    assert echo.wait() == 0
    assert "name: 'driver: battery'" in echo.text
    node.signal_group(signal.SIGINT)
    node.wait()


def test_the_markers_are_offered(run):
    node = run(sys.executable, "-c", blocks_of(PAGE, "python")[1])
    service = "/slider/get_interactive_markers"
    call = run(ROS2, "service", "call", service, "visualization_msgs/srv/GetInteractiveMarkers")
    assert call.wait() == 0
    for shown in ("name='gripper'", "title='Open'", "name='along_x'"):
        assert shown in call.text
    moved = "{marker_name: gripper, event_type: 1, pose: {position: {x: 0.25}}}"
    words = ("--once", "/slider/feedback", "visualization_msgs/msg/InteractiveMarkerFeedback")
    assert run(ROS2, "topic", "pub", *words, moved).wait() == 0
    node.wait_for(r"\[slider\]: gripper is at x = 0\.25$")
    node.signal_group(signal.SIGINT)
    node.wait()


def test_the_commands_run(run):
    programs = [run(ROS2, *line.split()[1:]) for line in blocks_of(PAGE, "sh")[0].splitlines()]
    for program in programs:
        program.wait_for("Hello World")
    for program in programs:
        program.signal_group(signal.SIGINT)
        assert program.wait() == 0


def test_the_components_are_loaded(run):
    start, *loads = [line.split()[1:] for line in blocks_of(PAGE, "sh")[1].splitlines()]
    container = run(ROS2, *start)
    seen = ""
    while "/ComponentManager" not in seen:
        listed = run(ROS2, "component", "list", "--spin-time", "0.5")
        assert listed.wait() == 0
        seen = listed.text
    for number, load in enumerate(loads, 1):
        loaded = run(ROS2, *load)
        assert loaded.wait() == 0
        assert f"Loaded component {number} " in loaded.text
    container.wait_for(r"\[listener\]: I heard: \[Hello World")
    container.signal_group(signal.SIGINT)
    assert container.wait() == 0


def test_a_missing_package_names_its_repository(run):
    command, *output = blocks_of(PAGE, "console")[0].splitlines()
    result = run(ROS2, *command.split()[2:])
    assert result.wait() == 1
    assert result.text.splitlines() == output


def test_the_table_says_what_the_errors_say():
    rows = re.findall(r"^\| `.*` \| (\S+), `(\S+)` \| `(.* (\S+))` \|$", PAGE, re.MULTILINE)
    assert len(rows) == 3
    for repository, branch, build, package in rows:
        hint = source_hint(package)
        assert f"git clone -b {branch} https://github.com/{repository};" in hint
        assert f"in the workspace: {build} &&" in hint


def test_the_launch_file_is_one(run, tmp_path):
    (tmp_path / "show_launch.py").write_text(blocks_of(PAGE, "python")[2])
    shown = run(ROS2, "launch", tmp_path / "show_launch.py", "--print-description")
    assert shown.wait() == 0, shown.text
    assert "IncludeLaunchDescription" in shown.text


@pytest.mark.parametrize(
    "package", ["cv_bridge", "diagnostic_updater", "interactive_markers", "demo_nodes_cpp"]
)
def test_the_page_names_every_package(package):
    assert f"`{package}`" in PAGE
