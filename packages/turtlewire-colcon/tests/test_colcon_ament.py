"""``colcon build`` and ``colcon test`` of ament_cmake packages, as typed, in a shell.

The builds use neither CMake nor a compiler; afterwards Python and ros2 find the packages. Each
package in ``good_packages.txt`` has the structure of a widely used one.
"""

from __future__ import annotations

import importlib.util
import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from tests import archive

PREFIX = Path(sys.prefix)

pytestmark = [
    pytest.mark.timeout(600),
    pytest.mark.slow,
    pytest.mark.skipif(
        importlib.util.find_spec("colcon_core") is None
        or importlib.util.find_spec("colcon_ros") is None,
        reason="needs colcon: pip install 'turtlewire-colcon[workspace]'",
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
colcon build > build.log 2>&1 || { cat build.log; exit 1; }
tail -1 build.log | cut -d[ -f1
source install/local_setup.bash
python -c 'from my_interfaces.msg import Sphere
from my_interfaces.srv import AddSphere; from my_interfaces.action import Roll
print(Sphere(radius=2.0), AddSphere.Request().sphere.radius, Roll.Result().where == Sphere())
from more_interfaces.msg import Pair; print(Pair().spheres[1] == Sphere())'
ros2 interface show my_interfaces/msg/Sphere
ros2 pkg prefix more_interfaces
ros2 topic pub -w 1 /sphere my_interfaces/msg/Sphere '{center: {x: 1.0}, radius: 5}' &> said.txt &
ros2 topic echo --once /sphere my_interfaces/msg/Sphere 2> hints.txt
kill $!
wait 2>/dev/null
colcon build --packages-select more_interfaces > build.log 2>&1 || { cat build.log; exit 1; }
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
    """Run a script; ``{prefix}`` in it is the prefix of the distribution.

    When it hangs, each of its Pythons shows its stacks.
    """
    environment = {
        "HOME": str(workspace / "home"),
        "PATH": "/usr/bin:/bin",
        "ROS_DOMAIN_ID": os.environ["ROS_DOMAIN_ID"],
        "PYTHONFAULTHANDLER": "1",
    }
    command = ["bash", "-c", script.replace("{prefix}", str(PREFIX))]
    with subprocess.Popen(
        command,
        cwd=workspace,
        env=environment,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    ) as process:
        try:
            output, errors = process.communicate(timeout=400)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGABRT)
            pytest.fail("\n".join(["it hangs", *process.communicate(timeout=60)]))
    return subprocess.CompletedProcess(command, process.returncode, output, errors)


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


def test_a_type_of_nobody_fails_the_build_with_its_line(workspace):
    path = workspace / "src/my_interfaces/srv/AddSphere.srv"
    path.write_text("Sphere sphere\n---\nnope_msgs/X[] x  # of nobody\nSpere last\n")
    done = run_in(
        workspace, "source {prefix}/setup.bash; colcon build --packages-select my_interfaces"
    )
    assert done.returncode == 1
    assert (
        "my_interfaces/srv/AddSphere, line 3: there is no nope_msgs/msg/X in 'nope_msgs/X[] x'; "
        "source or install what has it, or build nope_msgs and name it in package.xml\n"
        "my_interfaces/srv/AddSphere, line 4: there is no my_interfaces/msg/Spere in 'Spere last'; "
        "add its file to rosidl_generate_interfaces()\n"
    ) in done.stderr


def test_a_package_without_cmakelists_is_told_in_one_line(workspace):
    (workspace / "src/my_interfaces/CMakeLists.txt").unlink()
    done = run_in(
        workspace, "source {prefix}/setup.bash; colcon build --packages-select my_interfaces"
    )
    assert done.returncode == 1
    folder = workspace / "src/my_interfaces"
    assert (
        f"ERROR:colcon:my_interfaces: there is no {folder}/CMakeLists.txt, which the build_type "
        "ament_cmake in package.xml requires\n"
    ) in done.stderr


def test_cmake_builds_compiled_packages_if_ament_cmake_exists(workspace):
    config = workspace / "ros/share/ament_cmake/cmake/ament_cmakeConfig.cmake"
    config.parent.mkdir(parents=True)
    config.touch()
    (workspace / "ros/COLCON_IGNORE").touch()
    cmake = workspace / "src/my_interfaces/CMakeLists.txt"
    cmake.write_text(cmake.read_text() + "add_executable(node node.cpp)\n")
    listed = "colcon list --packages-select my_interfaces more_interfaces"
    script = f"source {PREFIX}/setup.bash; {listed}; AMENT_PREFIX_PATH=$PWD/ros {listed}"
    done = run_in(workspace, script)
    assert done.stdout.splitlines() == [
        "more_interfaces\tsrc/more_interfaces\t(ros.turtlewire_ament)",
        "my_interfaces\tsrc/my_interfaces\t(ros.turtlewire_ament)",
        "more_interfaces\tsrc/more_interfaces\t(ros.turtlewire_ament)",
        "my_interfaces\tsrc/my_interfaces\t(ros.ament_cmake)",
    ], done.stderr


def test_a_broken_manifest_is_named_with_its_line(workspace):
    manifest = workspace / "src/my_interfaces/package.xml"
    manifest.write_text(manifest.read_text().replace("</depend>", "</depend><br>"))
    done = run_in(workspace, "source {prefix}/setup.bash; colcon list")
    assert (
        "src/my_interfaces/package.xml:10: <br> is never closed; remove it, or add </br>"
        in done.stderr
    )
    manifest.write_text(manifest.read_text().replace("<br>", "").replace("@example.com", ""))
    done = run_in(workspace, "source {prefix}/setup.bash; colcon list")
    assert 'package.xml: Invalid email "someone" for person "someone"' in done.stderr
    assert "my_interfaces\tsrc/my_interfaces\t(turtlewire.unreadable)" in done.stdout


# The packages in good_packages.txt: built once, then used by each test.

HERE = Path(__file__).parent


def shell(workspace: Path, script: str) -> list[str]:
    """Run a script in a shell that has sourced the workspace; returns the lines it prints."""
    setup = "source {prefix}/setup.bash; source install/setup.bash\n"
    done = run_in(workspace, setup + script)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout.splitlines()


@pytest.fixture(scope="module")
def built(tmp_path_factory):
    """The good packages, built, and the output of the build as `built_output`."""
    folder = tmp_path_factory.mktemp("good_packages")
    archive.unpack(HERE / "good_packages.txt", folder / "src")
    # Of the tutorial's three commands, the third one sources the result.
    script = """
source {prefix}/setup.bash
rosdep install -i --from-path src --rosdistro jazzy -y &&
colcon build --cmake-args -DROBOT=2.5
"""
    done = run_in(folder, script)
    assert done.returncode == 0, done.stdout + done.stderr
    (folder / "output.txt").write_text(done.stdout + done.stderr)
    return folder


def test_a_target_of_cpp_is_told_and_the_python_beside_it_is_installed(built):
    output = (built / "output.txt").read_text()
    assert "Summary: 13 packages finished" in output
    file = built / "src/updater/CMakeLists.txt"
    assert (
        f"WARNING:colcon:updater: {file}:21: turtlewire compiles no C++, so example is left out; "
        "the rest of the package is installed\n"
    ) in output
    assert shell(built, "ros2 run updater example.py") == ["motor"]
    headers = built / "install/updater/include/updater/updater"
    assert [path.name for path in headers.iterdir()] == ["updater.hpp"]


def test_a_package_of_cpp_is_installed_without_its_programs(built):
    output = (built / "output.txt").read_text()
    file = built / "src/walker_cpp/CMakeLists.txt"
    lines = [line for line in output.splitlines() if "WARNING:colcon:walker_cpp:" in line]
    assert [line.partition(f"{file}:")[2] for line in lines] == [
        (
            "14: turtlewire compiles no C++, so walker_component, walk are left out; the rest of "
            "the package is installed"
        ),
        "11: gait_planner has no libraries",
        (
            "6: there is no package 'gait_planner'; add it to the workspace, source a workspace "
            "that has it, or install it"
        ),
        (f"20: install(FILES): there is no {built}/build/walker_cpp/walker_component_export.h"),
    ]
    hint = "walk is a C++ program, which turtlewire does not compile. Run it on a computer with"
    script = """
ros2 pkg prefix walker_cpp
ros2 run walker_cpp walk 2>&1
ros2 launch walker_cpp walk.launch.py 2>&1 | grep -o 'walk is a C++ program.* with '
"""
    prefix, *said = shell(built, script)
    assert prefix == f"{built}/install/walker_cpp"
    assert said[0] == "No executable found"
    assert said[1].startswith(hint)
    assert said[2].startswith(hint)


def test_rosdep_resolves_build_tools_cpp_and_python(built):
    script = """
cat > src/updater/package.xml <<END
<package format="3"><name>updater</name><version>0.0.0</version><description>d</description>
<maintainer email="a@b.cc">a</maintainer><license>MIT</license>
<depend>ament_cmake_ros</depend><depend>rclcpp</depend><depend>rclcpp_components</depend>
<depend>eigen</depend><depend>python3-a-key-of-nobody</depend><depend>python3-serial</depend>
</package>
END
rosdep install -i --from-path src/updater -y --simulate 2>&1; echo $?
sed -i s/python3-a-key-of-nobody/python3-scipy/ src/updater/package.xml
rosdep install -i --from-path src/updater -y --simulate 2>&1
"""
    lines = shell(built, script)
    unknown = "updater: Cannot locate rosdep definition for [python3-a-key-of-nobody]"
    assert [line for line in lines if "Cannot locate" in line] == [unknown]
    assert any(line.endswith("install -U pyserial") for line in lines)
    assert not [line for line in lines if "sudo" in line]


def test_scripts_modules_and_launch_files(built):
    script = """
ros2 run macro_tool expand 'Hi $NAME' you
macro_tool 'Hi $NAME' bin
expand 'Hi $NAME' again
macro_link 'Hi $NAME' link
ros2 pkg executables bridge_server
ros2 run bridge_server bridge.py /b /a
python -c 'import bridge_tools; print(bridge_tools.shorten("/a/b"))
from importlib.metadata import version; print(version("bridge_server"), version("macro_tool"))'
ros2 launch bridge_server bridge_launch.xml topic:=/here 2>&1 | grep -o "'/here'"
ros2 launch nav_bringup bringup_launch.py 2>&1 | grep -o nav_bringup
ros2 run sliders sliders
"""
    assert shell(built, script) == [
        "Hi you",
        "Hi bin",
        "Hi again",
        "Hi link",
        "bridge_server bridge",
        "bridge_server bridge.py",
        "['/a', '/b']",
        "b",
        "2.0.0 1.2.3",
        "'/here'",
        "nav_bringup",
        "sliders",
    ]


def test_data_templates_extras_and_hooks(built):
    share = built / "install/nav_bringup/share/nav_bringup"
    assert (share / "config/robot.yaml").read_text() == (
        "greeting: ROBOT!\nknows: of 1.2.3\nas_is: ${greeting}\n"
    )
    assert (share / "robot.txt").read_text() == "robot 2.5"
    assert (share / "hello.txt").read_text() == "Hello nav_bringup\n"
    assert sorted(path.name for path in (share / "maps").iterdir()) == ["office.yaml"]
    index = built / "install/nav_bringup/share/ament_index/resource_index"
    assert (index / "nav_plugins/nav_bringup").read_text() == "planner;controller"
    robot = built / "install/robot_description/share/robot_description"
    assert (robot / "launch/display.launch.py").is_file()
    assert (robot / "urdf/arm.urdf").is_file()
    assert [path.name for path in (robot / "meshes").iterdir()] == ["arm.stl"]
    dog = (robot / "robots/leg.urdf").read_text()
    assert 'name="dog"' in dog
    assert '<link name="left_leg"/>' in dog
    assert shell(built, "echo $NAV_ROBOT; echo $NAV_RESOURCE_PATH; echo $NAV_MAP_PATH") == [
        "nav_bringup",
        f"{built}/install/nav_bringup/share",
        f"{built}/install/nav_bringup/share/nav_bringup/maps",
    ]


def test_interfaces_with_extras_bounds_defaults_and_idl(built):
    script = """
ros2 interface package all_msgs | sort
ros2 interface show all_msgs/msg/Shape | grep -v "^\t" | head -7
python - <<END
from all_msgs.action import Count
from all_msgs.msg import Bounds, Defaults, Own, Shape
from geo_msgs.srv import GetRoute
from turtlewire import msg
print(Shape().name, Shape().size, Shape.LABEL, Shape.KIND, Shape.SOLID, len(Shape().ends))
print(Bounds.MOST, Bounds.HASH, Bounds.MASK, len(Bounds().two), Bounds().two[1].number)
print(Defaults().names, Defaults().fixed.tolist(), Defaults().text)
print(Count.Feedback().stamp.sec, GetRoute.Response().plan.places)
own = Own(); own.shape.words = ["abc"]; own.bounds.wide = "ü"; own.bounds.pairs = ["ab"]
print(msg.deserialize(Own, msg.serialize(own)) == own)
own.shape.words = ["abcd"]
try:
    msg.serialize(own)
except ValueError as error:
    print("shape.words" in str(error))
END
"""
    assert shell(built, script) == [
        "all_msgs/action/Count",
        "all_msgs/msg/Bounds",
        "all_msgs/msg/Defaults",
        "all_msgs/msg/Own",
        "all_msgs/msg/Shape",
        "all_msgs/srv/Empty",
        "# A shape",
        "# of two lines; with a semicolon",
        "byte KIND = 3",
        "float32 LIMIT = 2.5",
        'string LABEL = "round"',
        "bool SOLID = TRUE",
        "builtin_interfaces/Time stamp",
        r"none 1.5 round b'\x03' True 2",
        r"18446744073709551615 a # is no comment here b'\x7f' 2 -7",
        "['a', 'b, c', ''] [1, 2, 3] it's",
        "0 []",
        "True",
        "True",
    ]
    share = built / "install/all_msgs/share"
    index = (share / "ament_index/resource_index/rosidl_interfaces/all_msgs").read_text()
    assert index.splitlines() == [
        "action/Count.action",
        "action/Count.idl",
        "msg/Bounds.idl",
        "msg/Bounds.msg",
        "msg/Defaults.idl",
        "msg/Defaults.msg",
        "msg/Own.idl",
        "msg/Own.msg",
        "msg/Shape.idl",
        "srv/Empty.idl",
        "srv/Empty.srv",
    ]
    assert {*index.splitlines()} <= {
        path.relative_to(share / "all_msgs").as_posix() for path in share.glob("all_msgs/*/*")
    }


def test_colcon_test_runs_what_the_package_adds(built):
    script = """
colcon test --packages-select macro_tool bridge_server > test.log 2>&1; echo $?
colcon test-result --verbose
"""
    lines = run_in(built, "source {prefix}/setup.bash; source install/setup.bash\n" + script)
    results = lines.stdout.splitlines()
    assert results[0] == "0"
    assert results[1] == (
        "build/macro_tool/test_results/macro_tool/macro_tool_wrong.xunit.xml: 1 test, 0 errors, "
        "1 failure, 0 skipped"
    )
    assert results[-1] == "Summary: 6 tests, 0 errors, 1 failure, 0 skipped"


def test_a_package_with_dashes_in_setup_cfg_runs_and_tests_its_launch(built):
    script = """
ros2 launch gripper_py grip.launch.yaml 2>&1 | grep -o 'gripped'
colcon test --packages-select gripper_py > test.log 2>&1; echo $?
colcon test-result --test-result-base build/gripper_py
"""
    assert shell(built, script) == [
        "gripped",
        "0",
        "Summary: 1 test, 0 errors, 0 failures, 0 skipped",
    ]


def test_links_to_the_sources_and_back_to_copies(built):
    script = """
colcon build --packages-select macro_tool --symlink-install > link.log 2>&1 || cat link.log
sed -i 's/import sys/import sys  # changed/' src/macro_tool/macro_tool/__init__.py
grep -c changed install/macro_tool/lib/python*/site-packages/macro_tool/__init__.py
colcon build --packages-select macro_tool > copy.log 2>&1 || cat copy.log
find install/macro_tool -type l ! -name macro_link
grep -c changed src/macro_tool/macro_tool/__init__.py
"""
    assert shell(built, script) == ["1", "1"]


def test_each_fault_is_one_line_that_names_file_and_line(tmp_path):
    archive.unpack(HERE / "bad_packages.txt", tmp_path / "src")
    script = "source {prefix}/setup.bash; colcon build --continue-on-error"
    done = run_in(tmp_path, script)
    assert done.returncode == 1
    for name, text in {
        "fatal": ":4: not on Linux",
        "misses": ":4: there is no package 'nobody_has_this_msgs'; add it to the workspace, ",
        "no_file": ":4: install(FILES): there is no ",
        "no_python": ":5: ament_python_install_package(no_python): there is no folder ",
        "not_closed": ":4: if() has no endif()",
        "of_ros1": ":4: catkin_install_python() is of ROS 1, whose packages do not run here",
        "outside": ":4: the destination ../../etc is outside of the install folder",
        "unknown": ":5: the command make_coffee() is not known; ",
    }.items():
        start = f"ERROR:colcon:{name}: {tmp_path}/src/{name}/CMakeLists.txt{text}"
        assert sum(start in line for line in done.stderr.splitlines()) == 1, (start, done.stderr)
    assert "wrong_definition/msg/A, line 2: 'floot64' is not a type" in done.stderr


def test_pip_installs_such_packages(tmp_path):
    """With three lines of pyproject.toml by pip itself, without them by our command."""
    for name in ("macro_tool", "bridge_msgs"):
        archive.unpack(HERE / "good_packages.txt", tmp_path / name, within=f"{name}/")
    (tmp_path / "macro_tool/pyproject.toml").write_text(
        '[build-system]\nrequires = ["turtlewire-colcon"]\n'
        'build-backend = "turtlewire_colcon.build_backend"\n'
    )
    script = """
source {prefix}/setup.bash
install="python -m pip install -q --no-deps --no-index --prefix env"
$install --no-build-isolation ./macro_tool
python -m turtlewire_colcon.pip_install --output wheels ./bridge_msgs
$install wheels/bridge_msgs-1.2.3-py3-none-any.whl
export AMENT_PREFIX_PATH=$PWD/env PYTHONPATH=$(echo $PWD/env/lib/python*/site-packages)
ros2 run macro_tool expand 'Hi $NAME' pip
env/bin/macro_tool 'Hi $NAME' bin
ros2 interface show bridge_msgs/srv/Topics
python -c 'from bridge_msgs.msg import Client; print(Client(address="me"))'
"""
    done = run_in(tmp_path, script)
    assert done.returncode == 0, done.stderr
    assert done.stdout.splitlines() == [
        "wheels/bridge_msgs-1.2.3-py3-none-any.whl",
        "Hi pip",
        "Hi bin",
        "---",
        "string[] topics",
        (
            "bridge_msgs.msg.Client(header=std_msgs.msg.Header(stamp=builtin_interfaces.msg.Time("
            "sec=0, nanosec=0), frame_id=''), address='me')"
        ),
    ]
