"""The commands and programs of the how-to pages of the tools, run.

A `text` block is what the block before it prints.
"""

import doctest
import re
import sys
import time

import pytest
from tests.how_to import blocks, wait_until_printed
from tests.places import HOW_TO, PATH

import tf2_geometry_msgs  # noqa: F401 -- registers what the page names
import tf2_ros
import tf2_sensor_msgs  # noqa: F401

PAGES = {
    "tf2_tools.md": 9,
    "turtlewire_frames.md": 5,
    "buffer_server.md": 3,
    "message_filter.md": 2,
}


@pytest.fixture(autouse=True)
def _shell(monkeypatch, real_middleware):
    monkeypatch.setenv("PATH", PATH)
    monkeypatch.setenv("PYTHONUTF8", "1")


@pytest.mark.slow
@pytest.mark.parametrize("page", PAGES)
def test_the_page_does_what_it_says(page, run):
    found = blocks((HOW_TO / page).read_text())
    assert len(found) == PAGES[page]
    last = None
    for kind, text in found:
        if kind == "text":
            wait_until_printed(text, last)
        elif kind == "python":
            last = repeated(run, sys.executable, "-c", text)
        else:
            assert kind == "sh"
            for line in text.replace("\\\n", "").splitlines():
                if line.endswith(" &"):
                    run("bash", "-c", f"exec {line.removesuffix(' &')}")
                else:
                    last = repeated(run, "bash", "-c", line)


def repeated(run, *words):
    """Run a program that ends; returns a function for what it prints, now or a second time."""
    first = [outcome_of_success(run, *words)]
    return lambda: first.pop() if first else outcome_of_success(run, *words)


def outcome_of_success(run, *words):
    """Run it until it succeeds: on a busy machine it may give up before it finds a frame."""
    limit = time.monotonic() + 60
    while (program := run(*words)).wait() != 0:
        assert time.monotonic() < limit, program.text
    return outcome(program)


def outcome(program):
    """What it printed, without its log."""
    assert program.wait() == 0, program.text
    return "".join(
        f"{line}\n" for line in program.text.splitlines() if not line.startswith("[INFO]")
    )


@pytest.mark.parametrize(
    ("page", "part", "command"),
    [
        (
            "tf2_tools.md",
            "Publish a static transform",
            "ros2 run tf2_ros static_transform_publisher",
        ),
        ("tf2_tools.md", "Print a transform", "ros2 run tf2_ros tf2_echo"),
        ("tf2_tools.md", "Measure rates and delays", "ros2 run tf2_ros tf2_monitor"),
        ("turtlewire_frames.md", "Watch the TF tree", "turtlewire frames"),
        ("view_frames.md", "Draw the TF tree (view_frames)", "ros2 run tf2_tools view_frames"),
    ],
)
def test_the_page_names_every_option(page, part, command, run):
    shown = outcome(run(*command.split(), "--help"))
    options = set(re.findall(r"--[a-z][a-z_-]*", shown)) - {"--help"}
    parts = re.split(r"^##? ", (HOW_TO / page).read_text(), flags=re.MULTILINE)
    (text,) = (each for each in parts if each.startswith(part))
    assert set(re.findall(r"`(--[a-z][a-z_-]*)", text)) == options


@pytest.mark.parametrize(
    ("page", "examples"), [("transform_messages.md", 25), ("view_frames.md", 4)]
)
def test_the_examples_do_what_the_page_says(page, examples):
    failed, tried = doctest.testfile(str(HOW_TO / page), module_relative=False)
    assert (failed, tried) == (0, examples)


def test_the_page_names_every_type_that_a_buffer_takes():
    page = (HOW_TO / "transform_messages.md").read_text()
    packages = ("geometry_msgs.", "sensor_msgs.", "nav_msgs.")
    taken = {
        kind.__name__
        for kind in tf2_ros.TransformRegistration._transforms
        if kind.__module__.startswith(packages)
    }
    assert {"PointStamped", "PointCloud2"} <= taken
    assert taken <= set(re.findall(r"(\w+)`", page))
