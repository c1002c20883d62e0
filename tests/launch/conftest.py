"""Launches within the test's process, and what they log."""

from __future__ import annotations

import os
import re
import sys
from pathlib import Path

import pytest

from launch import LaunchContext, LaunchDescription, LaunchService, logging

ROS2 = Path(sys.executable).parent / "ros2"


class Outcome:
    """What a launch did: exit status, lines on the screen, its context and log folder."""

    def __init__(self, status, text, context, log_dir):
        self.status = status
        self.lines = text.splitlines()
        self.text = text
        self.context = context
        self.log_dir = Path(log_dir)

    @property
    def messages(self):
        """What `LogInfo` logged, in order."""
        return [match[1] for line in self.lines if (match := re.fullmatch(r"\[INFO\] \[launch\.user\]: (.*)", line))]

    @property
    def error(self):
        """What ended the launch."""
        head = "[ERROR] [launch]: Caught exception in launch (see debug for traceback): "
        (found,) = (line.removeprefix(head) for line in self.lines if line.startswith(head))
        return found


@pytest.fixture
def launch(capsys, monkeypatch, tmp_path):
    """Runs entities to their end; an exception of the launch itself is in `error`."""
    environment = dict(os.environ)
    monkeypatch.setenv("ROS_LOG_DIR", str(tmp_path / "log"))

    def start(*entities, **options):
        logging.reset()
        capsys.readouterr()
        service = LaunchService(**{"noninteractive": True, **options})
        service.include_launch_description(LaunchDescription(entities))
        status = service.run()
        return Outcome(status, capsys.readouterr().out, service.context, logging.launch_config.log_dir)

    yield start
    logging.reset()
    for name in set(os.environ) - set(environment):
        del os.environ[name]
    os.environ.update(environment)


@pytest.fixture
def context():
    """A context for substitutions that need no running launch."""
    return LaunchContext()


@pytest.fixture
def ros2_launch(run, tmp_path):
    """Runs `ros2 launch` on a launch file in a process of its own."""

    def start(content, *arguments, name="test.launch.py", **options):
        (tmp_path / name).write_text(content)
        return run(ROS2, "launch", f"./{name}", *arguments, cwd=tmp_path, **options)

    return start
