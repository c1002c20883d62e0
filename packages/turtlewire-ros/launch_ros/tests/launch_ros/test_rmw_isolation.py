"""A launch in a separate domain."""

import os
import sys

import pytest

from launch import LaunchDescription, LaunchService
from launch.actions import ExecuteProcess
from launch_testing_ros.actions import EnableRmwIsolation
from turtlewire.testing import reserved_domain

PROGRAM = "import os, pathlib; pathlib.Path({!r}).write_text(os.environ['ROS_DOMAIN_ID'])"


@pytest.mark.parametrize("former", [None, "0"])
def test_the_processes_have_a_domain_of_their_own(monkeypatch, tmp_path, former):
    monkeypatch.setenv("ROS_LOG_DIR", str(tmp_path))
    monkeypatch.delenv("ROS_DOMAIN_ID", raising=False)
    if former is not None:
        monkeypatch.setenv("ROS_DOMAIN_ID", former)
    file = tmp_path / "domain"
    with reserved_domain() as taken:  # the first free one, which the launch would take
        service = LaunchService(noninteractive=True)
        node = ExecuteProcess(cmd=[sys.executable, "-c", PROGRAM.format(str(file))])
        service.include_launch_description(LaunchDescription([EnableRmwIsolation(), node]))
        assert service.run() == 0
        assert 1 <= int(file.read_text()) <= 101
        assert file.read_text() != str(taken)
    assert os.environ.get("ROS_DOMAIN_ID") == former
