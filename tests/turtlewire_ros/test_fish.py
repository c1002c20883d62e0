"""The shell files for fish: the same environment as in bash, and completion."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

FILES = Path(__file__).parents[2] / "ros/turtlewire_ros/environment"

pytestmark = pytest.mark.skipif(shutil.which("fish") is None, reason="needs fish")


@pytest.fixture
def prefix(tmp_path):
    for name in ("setup.fish", "local_setup.fish"):
        shutil.copy(FILES / name, tmp_path)
    return tmp_path.resolve()


def fish(home, script, *options, **variables):
    environment = {"HOME": str(home / "home"), "PATH": "/usr/bin:/bin", **variables}
    done = subprocess.run(["fish", *options, "-c", script], env=environment, capture_output=True, text=True, check=True, timeout=60)
    assert done.stderr == ""
    return done.stdout.splitlines()


@pytest.mark.parametrize("name", ["setup.fish", "local_setup.fish"])
def test_the_environment_is_set_once(prefix, name):
    names = ("AMENT_PREFIX_PATH", "ROS_DISTRO", "ROS_VERSION", "ROS_PYTHON_VERSION", "ROS_HOME", "ROS_LOG_DIR")
    script = f"source {prefix}/{name}; source {prefix}/{name}; printenv {'; printenv '.join(names)}"
    home, logs = f"{prefix}/share/turtlewire/ros_home", f"{prefix}/home/.ros/log"
    assert fish(prefix, script) == [str(prefix), "jazzy", "2", "3", home, logs]
    assert fish(prefix, script, AMENT_PREFIX_PATH="/a:/b")[0] == f"{prefix}:/a:/b"


def test_a_users_own_rosdep_cache_is_left_alone(prefix):
    cache = prefix / "home/.ros/rosdep/sources.cache"
    cache.mkdir(parents=True)
    (cache / "index").touch()
    assert fish(prefix, f'source {prefix}/setup.fish; echo "[$ROS_HOME]"') == ["[]"]


def test_words_are_completed(prefix):
    ros2 = prefix / "bin/ros2"
    ros2.parent.mkdir()
    ros2.write_text(f"#!{sys.executable}\n# PYTHON_ARGCOMPLETE_OK\nimport sys\nfrom ros2cli.main import main\nsys.exit(main())\n")
    ros2.chmod(0o755)
    path = os.pathsep.join((str(ros2.parent), str(Path(sys.executable).parent), "/usr/bin", "/bin"))
    script = f"source {prefix}/setup.fish; complete -C 'ros2 topic e'"
    offered = fish(prefix, script, "--interactive", PATH=path, TERM="dumb")
    assert [line.split("\t")[0].strip() for line in offered] == ["echo"]
