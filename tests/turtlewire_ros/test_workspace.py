"""The tutorial's build section, as typed, in a shell: rosdep, colcon, local_setup.bash, ros2."""

from __future__ import annotations

import importlib.util
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

VERBATIM = Path(__file__).parents[1] / "tutorial/verbatim/learning_tf2_py"
PREFIX = Path(sys.prefix)

SCRIPT = """
source {prefix}/setup.bash
cd src && ros2 pkg create --build-type ament_python --node-name n p > /dev/null && cd ..
rosdep install -i --from-path src --rosdistro jazzy -y || exit 1
colcon build --symlink-install || exit 2
source install/local_setup.bash
ros2 pkg executables learning_tf2_py
ros2 run p n
sed -i 's/Hi from/Hello from/' src/p/p/n.py
ros2 run p n
ros2 launch learning_tf2_py turtle_tf2_demo.launch.py -p | head -1
"""


@pytest.mark.slow
@pytest.mark.skipif(
    importlib.util.find_spec("colcon_core") is None or importlib.util.find_spec("rosdep2") is None,
    reason="needs colcon and rosdep: pip install 'turtlewire-ros[workspace]'",
)
@pytest.mark.skipif(not (PREFIX / "setup.bash").is_file(), reason="needs the installed distribution, with its setup.bash")
def test_the_build_section(tmp_path):
    (tmp_path / "src").mkdir()
    shutil.copytree(VERBATIM, tmp_path / "src/learning_tf2_py", ignore=shutil.ignore_patterns("__pycache__", "*.egg-info"))
    environment = {"HOME": str(tmp_path / "home"), "PATH": "/usr/bin:/bin", "ROS_DOMAIN_ID": os.environ["ROS_DOMAIN_ID"]}
    (tmp_path / "home").mkdir()
    result = subprocess.run(
        ["bash", "-c", SCRIPT.format(prefix=PREFIX)], cwd=tmp_path, env=environment, capture_output=True, text=True, check=False
    )
    assert result.returncode == 0, result.stderr
    lines = result.stdout.splitlines()
    assert lines[0] == "#All required rosdeps installed successfully"
    assert any(line.startswith("Summary: 2 packages finished") for line in lines)
    assert lines[-5:-1] == [
        "learning_tf2_py turtle_tf2_broadcaster",
        "learning_tf2_py turtle_tf2_listener",
        "Hi from p.",
        "Hello from p.",
    ]
    assert lines[-1].startswith("<launch.launch_description.LaunchDescription object")
    assert result.stderr == ""
