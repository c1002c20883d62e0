"""Whole programs: an example of ROS 2, and the programs of docs/how-to/asyncio.md."""

import signal

import pytest
from tests.how_to import blocks, blocks_of
from tests.places import HOW_TO


def test_remapping_on_the_command_line(program, monkeypatch):
    monkeypatch.setenv("RCUTILS_LOGGING_USE_STDOUT", "1")
    main = "from examples_rclpy_minimal_{0}.{0}_member_function import main\nmain()"
    rules = ("--ros-args", "-r", "topic:=/elsewhere", "-r", "__node:=ears")
    subscriber = program(main.format("subscriber"), *rules)
    rules = ("--ros-args", "--remap", "topic:=elsewhere", "--log-level", "warn")
    publisher = program(main.format("publisher"), *rules)
    assert '[ears]: I heard: "Hello World: ' in subscriber.read_line()
    for each in (publisher, subscriber):
        each.send_signal(signal.SIGTERM)
    assert publisher.finish() == (0, "", "")
    assert subscriber.finish()[::2] == (0, "")


PAGE = (HOW_TO / "asyncio.md").read_text()
PROGRAMS, OUTPUTS = blocks_of(PAGE, "python"), blocks_of(PAGE, "text")


def test_each_program_has_its_output():
    assert [kind for kind, _ in blocks(PAGE)] == ["python", "text"] * 4


@pytest.mark.parametrize("middleware", ["local", "rmw_cyclonedds_cpp"])
@pytest.mark.parametrize("index", range(4))
def test_a_program_prints_what_the_page_says(program, monkeypatch, middleware, index):
    monkeypatch.setenv("RMW_IMPLEMENTATION", middleware)
    monkeypatch.setenv("PYTHONWARNINGS", "error")
    assert program(PROGRAMS[index]).finish() == (0, OUTPUTS[index], "")
