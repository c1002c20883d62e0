"""``colcon build`` of a user's own interface packages, as typed, in a shell.

No CMake, no compiler, then Python and ros2 know them.
"""

from __future__ import annotations

import importlib.util
import os
import subprocess
import sys
from pathlib import Path

import pytest

PREFIX = Path(sys.prefix)

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(
        importlib.util.find_spec("colcon_core") is None
        or importlib.util.find_spec("colcon_ros") is None,
        reason="needs colcon: pip install 'turtlewire-ros[workspace]'",
    ),
    pytest.mark.skipif(
        not (PREFIX / "setup.bash").is_file(),
        reason="needs the installed distribution, with its setup.bash",
    ),
]

PACKAGE_XML = """<?xml version="1.0"?>
<package format="3">
  <name>{name}</name>
  <version>0.0.0</version>
  <description>Interfaces</description>
  <maintainer email="someone@example.com">someone</maintainer>
  <license>Apache-2.0</license>
  <buildtool_depend>ament_cmake</buildtool_depend>
  <buildtool_depend>rosidl_default_generators</buildtool_depend>
  <depend>{depend}</depend>
  <exec_depend>rosidl_default_runtime</exec_depend>
  <member_of_group>rosidl_interface_packages</member_of_group>
  <export><build_type>ament_cmake</build_type></export>
</package>
"""

CMAKE = """cmake_minimum_required(VERSION 3.8)
project({name})
find_package(ament_cmake REQUIRED)
find_package({depend} REQUIRED)
find_package(rosidl_default_generators REQUIRED)
rosidl_generate_interfaces(${{PROJECT_NAME}} {files} DEPENDENCIES {depend})
ament_package()
"""

PACKAGES = {
    "my_interfaces": ("geometry_msgs", {
        "msg/Sphere.msg": "geometry_msgs/Point center\nfloat64 radius\n",
        "srv/AddSphere.srv": "Sphere sphere\n---\nbool success\n",
        "action/Roll.action": "float32 distance\n---\nSphere where\n---\nfloat32 left\n",
    }),
    "more_interfaces": ("my_interfaces", {"msg/Pair.msg": "my_interfaces/Sphere[2] spheres\n"}),
}  # fmt: skip

SCRIPT = """
source {prefix}/setup.bash
colcon build > build.log 2>&1 || {{ cat build.log; exit 1; }}
tail -1 build.log | cut -d[ -f1
source install/local_setup.bash
python -c 'from my_interfaces.msg import Sphere
from my_interfaces.srv import AddSphere; from my_interfaces.action import Roll
print(Sphere(radius=2.0), AddSphere.Request().sphere.radius, Roll.Result().where == Sphere())
from more_interfaces.msg import Pair; print(Pair().spheres[1] == Sphere())'
ros2 interface show my_interfaces/msg/Sphere
ros2 pkg prefix more_interfaces
ros2 topic echo --once /sphere my_interfaces/msg/Sphere > heard.txt &
ros2 topic pub --once -w 1 /sphere my_interfaces/msg/Sphere \\
    '{{center: {{x: 1.0}}, radius: 5}}' > said.txt
wait
cat heard.txt
colcon build --packages-select more_interfaces > build.log 2>&1 || {{ cat build.log; exit 1; }}
tail -1 build.log | cut -d[ -f1
"""


@pytest.fixture
def workspace(tmp_path):
    for name, (depend, files) in PACKAGES.items():
        folder = tmp_path / "src" / name
        for path, text in files.items():
            (folder / path).parent.mkdir(parents=True, exist_ok=True)
            (folder / path).write_text(text)
        (folder / "package.xml").write_text(PACKAGE_XML.format(name=name, depend=depend))
        quoted = " ".join(f'"{path}"' for path in files)
        (folder / "CMakeLists.txt").write_text(CMAKE.format(name=name, depend=depend, files=quoted))
    return tmp_path


def run_in(workspace: Path, script: str) -> subprocess.CompletedProcess[str]:
    environment = {
        "HOME": str(workspace / "home"),
        "PATH": "/usr/bin:/bin",
        "ROS_DOMAIN_ID": os.environ["ROS_DOMAIN_ID"],
    }
    command = ["bash", "-c", script.format(prefix=PREFIX)]
    return subprocess.run(
        command, cwd=workspace, env=environment, capture_output=True, text=True, check=False
    )


def test_built_sourced_used(workspace):
    done = run_in(workspace, SCRIPT)
    assert done.returncode == 0, done.stdout + done.stderr
    assert done.stderr == ""
    assert done.stdout.splitlines() == [
        "Summary: 2 packages finished ",
        (
            "my_interfaces.msg.Sphere(center=geometry_msgs.msg.Point(x=0.0, y=0.0, z=0.0), "
            "radius=2.0) 0.0 True"
        ),
        "True",
        "geometry_msgs/Point center",
        "\tfloat64 x",
        "\tfloat64 y",
        "\tfloat64 z",
        "float64 radius",
        f"{workspace}/install/more_interfaces",
        "center:",
        "  x: 1.0",
        "  y: 0.0",
        "  z: 0.0",
        "radius: 5.0",
        "---",
        "Summary: 1 package finished ",
    ]


def test_a_mistake_in_a_definition_fails_the_build_with_its_line(workspace):
    (workspace / "src/my_interfaces/msg/Sphere.msg").write_text("floot64 radius\n")
    done = run_in(
        workspace, "source {prefix}/setup.bash; colcon build --packages-select my_interfaces"
    )
    assert done.returncode == 1
    assert (
        "my_interfaces/msg/Sphere, line 1: 'floot64' is not a type in 'floot64 radius'"
        in done.stderr
    )


def test_packages_with_code_stay_with_colcon_ros(workspace):
    cmake = workspace / "src/my_interfaces/CMakeLists.txt"
    cmake.write_text(cmake.read_text() + "add_executable(node node.cpp)\n")
    done = run_in(workspace, "source {prefix}/setup.bash; colcon list")
    assert done.stdout.splitlines() == [
        "more_interfaces\tsrc/more_interfaces\t(ros.turtlewire_interfaces)",
        "my_interfaces\tsrc/my_interfaces\t(ros.ament_cmake)",
    ]


def test_a_broken_manifest_is_named_with_its_line(workspace):
    manifest = workspace / "src/my_interfaces/package.xml"
    manifest.write_text(manifest.read_text().replace("</depend>", "</depend><br>"))
    done = run_in(workspace, "source {prefix}/setup.bash; colcon list")
    assert (
        "src/my_interfaces/package.xml:10: <br> is never closed; remove it, or add </br>"
        in done.stderr
    )
