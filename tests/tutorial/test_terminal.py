"""The tutorial's terminal work on a machine without ROS.

A fresh venv, a fresh home, and the commands as they are typed there.

The venv is filled from the wheelhouse that `scripts/smoke` makes, and from nothing else; what is
run afterwards gets no network.
"""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from tests.places import HOW_TO, PACKAGES, ROOT

HERE = Path(__file__).parent
VERBATIM = HERE / "verbatim/learning_tf2_py"
WHEELHOUSE = ROOT / "build/wheelhouse" / f"{sys.version_info.major}.{sys.version_info.minor}"
UP, LEFT = "\x1b[A", "\x1b[D"


def why_not():
    """The reason why there is no wheelhouse of these sources; empty when there is one."""
    wheels = [*WHEELHOUSE.glob("turtlewire-*.whl"), *WHEELHOUSE.glob("turtlewire_ros-*.whl")]
    if len(wheels) != 2:
        return f"needs wheels in {WHEELHOUSE.relative_to(ROOT)}: scripts/smoke makes them"
    sources = [path for folder in PACKAGES for path in folder.rglob("*.py")]
    if min(wheel.stat().st_mtime for wheel in wheels) < max(
        path.stat().st_mtime for path in sources
    ):
        return (
            f"the wheels in {WHEELHOUSE.relative_to(ROOT)} are older than the sources: "
            "scripts/smoke rebuilds them"
        )
    return ""


pytestmark = [
    pytest.mark.slow,
    pytest.mark.timeout(300),
    pytest.mark.skipif(bool(why_not()), reason=why_not()),
]


@pytest.fixture(scope="module")
def venv(tmp_path_factory):
    """A fresh venv with what `pip install 'turtlewire-colcon[workspace]'` brings."""
    folder = tmp_path_factory.mktemp("machine") / "venv"
    subprocess.run([sys.executable, "-m", "venv", folder], check=True)
    pip = [folder / "bin/pip", "install", "-q", "--no-index", "--find-links", WHEELHOUSE]
    subprocess.run([*pip, "turtlewire-colcon[workspace]"], check=True)
    return folder


@pytest.fixture
def home(tmp_path):
    """A home folder with a workspace in which the tutorial's listings are."""
    shutil.copytree(
        VERBATIM,
        tmp_path / "ros2_ws/src/learning_tf2_py",
        ignore=shutil.ignore_patterns("__pycache__", "*.egg-info"),
    )
    return tmp_path


@pytest.fixture
def bash(run, venv, home):
    """Opens a terminal.

    A shell in the home folder which knows nothing but the venv, and in which commands are typed.
    """

    def environment():
        kept = {
            name: value
            for name, value in os.environ.items()
            if name.startswith(("ROS_", "TURTLEWIRE_TEST"))
        }
        nowhere = "http://127.0.0.1:9"
        offline = {
            "http_proxy": nowhere,
            "https_proxy": nowhere,
            "PIP_NO_INDEX": "1",
            "PIP_FIND_LINKS": str(WHEELHOUSE),
        }
        screen = {"TURTLEWIRE_PORT": "0", "TURTLEWIRE_BROWSER": "0", "LANG": "C.UTF-8"}
        return [
            f"{name}={value}"
            for name, value in (
                {"HOME": home, "PATH": "/usr/bin:/bin"} | kept | offline | screen
            ).items()
        ]

    def start(*lines, **options):
        script = "\n".join(["set -e", f"source {venv}/setup.bash", "cd ~/ros2_ws", *lines])
        return run(
            "env",
            "-i",
            *environment(),
            "TERM=dumb",
            "bash",
            "--norc",
            "-c",
            script,
            cwd=home,
            **options,
        )

    return start


def built(bash):
    """Types the tutorial's build section."""
    build = bash(
        "rosdep install -i --from-path src --rosdistro jazzy -y", "colcon build --symlink-install"
    )
    assert build.wait(120) == 0, build.text
    lines = build.text.splitlines()
    assert lines[0] == "#All required rosdeps installed successfully"
    assert lines[1].startswith("Starting >>> learning_tf2_py"), build.text
    assert lines[2].startswith("Finished <<< learning_tf2_py"), build.text
    assert lines[-1].startswith("Summary: 1 package finished"), build.text
    assert len([line for line in lines if line]) == 4, build.text


def drive(turtles, teleop, key, arrived):
    """Press a key until turtle1 has arrived and stands.

    The first ones may be typed before the programs know each other.
    """

    def done():
        pose = turtles.poses["turtle1"]
        return arrived(pose) and pose.linear_velocity == pose.angular_velocity == 0.0

    with turtles.more:
        for _ in range(30):
            teleop.type(key)
            if turtles.more.wait_for(done, 5):
                return
    raise AssertionError(turtles.poses, teleop.text)


def test_the_five_commands(bash, turtles):
    built(bash)
    launch = bash(
        "source install/setup.bash", "ros2 launch learning_tf2_py turtle_tf2_demo.launch.py"
    )
    launch.wait_for("Could not retrieve transform")  # the listings spawn no turtle2
    spawn = bash(
        'ros2 service call /spawn turtlesim/srv/Spawn "{x: 4.0, y: 2.0, theta: 0.0, name: '
        "'turtle2'}\""
    )
    assert spawn.wait() == 0, spawn.text
    turtles.wait_for(lambda: len(turtles.poses) == 2 and turtles.distance() < 0.1)

    teleop = bash("ros2 run turtlesim turtle_teleop_key", terminal=True)
    teleop.wait_for("'Q' to quit")
    drive(turtles, teleop, LEFT, lambda pose: pose.theta > 1.0)
    drive(turtles, teleop, UP, lambda pose: pose.y > 7.0)
    leader = turtles.poses["turtle1"]
    turtles.wait_for(lambda: turtles.distance() < 0.1)
    follower = turtles.poses["turtle2"]
    assert follower.y > 6.9
    assert (leader.x, leader.y) == (turtles.poses["turtle1"].x, turtles.poses["turtle1"].y)

    teleop.type("q")
    assert teleop.wait() == 0, teleop.text
    launch.end()
    assert "Traceback" not in launch.text + teleop.text


PACKAGE = """
cd src && ros2 pkg create --build-type ament_python --node-name n p > /dev/null && cd ..
rosdep install -i --from-path src --rosdistro jazzy -y
colcon build --symlink-install --packages-select p
source install/setup.bash
ros2 run p n
sed -i 's/Hi from/Hello from/' src/p/p/n.py
ros2 run p n
"""


def test_the_how_to_page_has_the_commands():
    page = (HOW_TO / "terminal.md").read_text()
    here = Path(__file__).read_text()
    for command in (
        "rosdep install -i",
        "colcon build",
        "source install",
        "ros2 launch learning_tf2_py",
        "ros2 run turtlesim",
    ):
        (line,) = [line for line in page.splitlines() if line.startswith(command)]
        assert f'"{line}"' in here


def test_a_new_package_is_built_and_edited_without_another_build(bash):
    shell = bash(PACKAGE)
    assert shell.wait(120) == 0, shell.text
    lines = shell.text.splitlines()
    assert lines[0] == "#All required rosdeps installed successfully"
    assert lines[-3].startswith("Summary: 1 package finished"), shell.text
    assert lines[-2:] == ["Hi from p.", "Hello from p."]


@pytest.mark.parametrize("how", ["./src/learning_tf2_py", "-e ./src/learning_tf2_py"])
def test_the_package_is_installed_by_pip(bash, how):
    shell = bash(
        f"pip install --disable-pip-version-check -q {how}",
        "ros2 pkg executables learning_tf2_py",
        "ros2 launch -p learning_tf2_py turtle_tf2_demo.launch.py",
        "cd / && ros2 launch -s learning_tf2_py turtle_tf2_demo.launch.py",
        "pip uninstall -q -y learning_tf2_py",
    )
    assert shell.wait(120) == 0, shell.text
    assert (
        "learning_tf2_py turtle_tf2_broadcaster\nlearning_tf2_py turtle_tf2_listener\n"
        in shell.text
    )
    assert "  No arguments." in shell.text


def test_the_tutorial_s_br_in_package_xml_is_named_with_its_line(bash, home):
    manifest = home / "ros2_ws/src/learning_tf2_py/package.xml"
    text = manifest.read_text().replace("<depend>launch</depend>", "<depend>launch</depend><br>")
    manifest.write_text(text)
    line = 1 + text[: text.index("<br>")].count("\n")
    told = f"package.xml:{line}: <br> is never closed; remove it, or add </br>"
    build = bash("colcon build --symlink-install")
    assert build.wait(120) == 1
    assert [line for line in build.text.splitlines() if "br" in line] == [
        line for line in build.text.splitlines() if told in line
    ]
    assert "ERROR:colcon:src/learning_tf2_py/" + told in build.text
    assert "1 package failed: learning_tf2_py" in build.text
