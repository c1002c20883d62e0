"""The commands and programs of the how-to pages of the tools, run.

A `text` block is what the block before it prints.
"""

from __future__ import annotations

import doctest
import os
import re
import sys
import time
from pathlib import Path

import pytest
from tests.places import HOW_TO

BIN = Path(sys.executable).parent
PAGES = {
    "static_transform_publisher.md": 3,
    "tf2_echo.md": 5,
    "tf2_monitor.md": 5,
    "turtlewire_frames.md": 5,
    "buffer_server.md": 3,
    "message_filter.md": 2,
}


@pytest.fixture(autouse=True)
def _real_middleware(monkeypatch, _local_middleware):
    monkeypatch.delenv("RMW_IMPLEMENTATION")
    monkeypatch.setenv("PATH", f"{BIN}{os.pathsep}{os.environ['PATH']}")
    monkeypatch.setenv("PYTHONUTF8", "1")


@pytest.mark.parametrize("page", PAGES)
def test_the_page_does_what_it_says(page, run):
    blocks = re.findall(
        r"^```(\w+)\n(.*?)^```$", (HOW_TO / page).read_text(), re.MULTILINE | re.DOTALL
    )
    assert len(blocks) == PAGES[page]
    last = None
    for kind, text in blocks:
        if kind == "text":
            wait_until_printed(text, last)
        elif kind == "python":
            last = Command(run, sys.executable, "-c", text)
        else:
            assert kind == "sh"
            for line in text.replace("\\\n", "").splitlines():
                if line.endswith(" &"):
                    run("bash", "-c", f"exec {line.removesuffix(' &')}")
                else:
                    last = Command(run, "bash", "-c", line)


class Command:
    """A program that ended, and what it printed; `repeat` runs it again."""

    def __init__(self, run, *words):
        self._run = run
        self._words = words
        self.repeat()

    def repeat(self):
        """Run it until it succeeds: on a busy machine it may give up before it finds a frame."""
        limit = time.monotonic() + 60
        while (program := self._run(*self._words)).wait() != 0:
            assert time.monotonic() < limit, program.text
        self.printed = outcome(program)


def wait_until_printed(text, command):
    """Repeat a command that looks at the graph until it prints the text.

    A page gives `tf2_monitor` two seconds, in which a busy machine may not find the other node.
    """
    limit = time.monotonic() + 60
    while not doctest.OutputChecker().check_output(
        text, command.printed, doctest.ELLIPSIS | doctest.DONT_ACCEPT_BLANKLINE
    ):
        assert time.monotonic() < limit, command.printed
        command.repeat()


def outcome(program):
    """What it printed, without its log."""
    assert program.wait() == 0, program.text
    return "".join(
        f"{line}\n" for line in program.text.splitlines() if not line.startswith("[INFO]")
    )


@pytest.mark.parametrize(
    ("page", "command"),
    [
        ("tf2_echo.md", "ros2 run tf2_ros tf2_echo"),
        ("tf2_monitor.md", "ros2 run tf2_ros tf2_monitor"),
        ("static_transform_publisher.md", "ros2 run tf2_ros static_transform_publisher"),
        ("turtlewire_frames.md", "turtlewire frames"),
    ],
)
def test_the_page_names_every_option(page, command, run):
    options = set(re.findall(r"--[a-z][a-z-]*", outcome(run(*command.split(), "--help")))) - {
        "--help"
    }
    assert options
    text = (HOW_TO / page).read_text()
    assert all(f"`{option}" in text for option in options), options
