"""`ros2` where another ROS 2 was sourced."""

import os

import pytest
from tests.programs import run_python

from turtlewire_ros.guard import foreign_package


def ros2(*words, path=""):
    program = (
        "import sys; from turtlewire_ros.guard import main; sys.argv[0] = 'ros2'; sys.exit(main())"
    )
    environment = {**os.environ, "PYTHONPATH": path}
    done = run_python(program, *words, check=False, timeout=300, env=environment)
    return done.returncode, done.stdout, done.stderr


def test_without_a_mixture_the_command_runs():
    assert foreign_package() is None
    status, shown, errors = ros2("pkg", "list")
    assert (status, errors) == (0, "")
    assert "turtlesim\n" in shown


@pytest.mark.parametrize("package", ["rclpy", "ros2cli"])
def test_packages_of_another_ros_are_named_in_one_line(tmp_path, package):
    folder = tmp_path / package
    folder.mkdir()
    (folder / "__init__.py").write_text("raise ImportError('half of a real ROS 2')\n")
    told = f"ros2: {folder} belongs to another ROS 2 and hides turtlewire's package. "
    told += "Use a shell in which no other ROS 2 is sourced, or unset PYTHONPATH.\n"
    assert ros2("topic", "list", path=str(tmp_path)) == (1, "", told)


INTERRUPTED = """
import os, signal, sys, weakref
import ros2cli.main
from turtlewire_ros import guard

class Module:
    pass

def run():
    module = Module()
    # Python drops what is raised in here, as at the end of an import.
    end = weakref.ref(module, lambda _: os.kill(os.getpid(), signal.SIGINT))
    del module
    return 0

ros2cli.main.main = run
sys.exit(guard.main())
"""


def test_ctrl_c_at_the_end_of_an_import_ends_ros2():
    done = run_python(INTERRUPTED, check=False, timeout=60)
    assert (done.returncode, done.stderr) == (2, "")
