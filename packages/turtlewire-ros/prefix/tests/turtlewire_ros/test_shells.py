"""The shell files.

Fish gets the same environment as bash, and bash, zsh and fish complete words, topics, nodes and
frames.
"""

import os
import shutil
import subprocess
import sys
from contextlib import suppress

import pytest
from tests.places import BIN, ROS

from turtlewire import msg
from turtlewire.wire import open_context
from turtlewire.wire.base import TypeId
from turtlewire.wire.qos import Durability, QoS

FILES = ROS / "prefix/turtlewire_ros/environment"

needs_fish = pytest.mark.skipif(
    shutil.which("fish") is None, reason="needs fish (Debian: apt install fish)"
)


@pytest.fixture
def prefix(tmp_path):
    for path in FILES.iterdir():
        shutil.copy(path, tmp_path)
    return tmp_path.resolve()


def fish(home, script, *options, **variables):
    environment = {"HOME": str(home / "home"), "PATH": "/usr/bin:/bin", **variables}
    done = subprocess.run(
        ["fish", *options, "-c", script],
        env=environment,
        capture_output=True,
        text=True,
        check=True,
        timeout=300,
    )
    assert done.stderr == ""
    return done.stdout.splitlines()


@needs_fish
@pytest.mark.parametrize("name", ["setup.fish", "local_setup.fish"])
def test_the_environment_is_set_once(prefix, name):
    names = (
        "AMENT_PREFIX_PATH",
        "ROS_DISTRO",
        "ROS_VERSION",
        "ROS_PYTHON_VERSION",
        "ROS_HOME",
        "ROS_LOG_DIR",
    )
    script = f"source {prefix}/{name}; source {prefix}/{name}; printenv {'; printenv '.join(names)}"
    home, logs = f"{prefix}/share/turtlewire/ros_home", f"{prefix}/home/.ros/log"
    assert fish(prefix, script) == [str(prefix), "jazzy", "2", "3", home, logs]
    assert fish(prefix, script, AMENT_PREFIX_PATH="/a:/b")[0] == f"{prefix}:/a:/b"


@pytest.fixture
def ros2(prefix):
    """A program in the prefix, which prints that it runs."""
    path = prefix / "bin" / "ros2"
    path.parent.mkdir()
    path.write_text("#!/bin/sh\necho it runs\n")
    path.chmod(0o755)


def sourced(shell, prefix, script, **variables):
    if shutil.which(shell) is None:
        pytest.skip(f"needs {shell} (Debian: apt install {shell})")
    return subprocess.run(
        [shell, "-c", script],
        env={"HOME": str(prefix / "home"), "PATH": "/usr/bin:/bin", **variables},
        capture_output=True,
        text=True,
        check=False,
        timeout=300,
        cwd=prefix,
    )


@pytest.mark.usefixtures("ros2")
@pytest.mark.parametrize("shell", ["bash", "zsh", "fish", "sh"])
def test_the_underlay_of_a_workspace_brings_its_commands(prefix, shell):
    """colcon's install/setup.bash sources local_setup.bash of the prefix it was built with."""
    file = prefix / f"local_setup.{shell}"
    script = f"source {file}; source {file}; ros2; echo $PATH"
    if shell == "sh":
        script = script.replace("source", ".")
    done = sourced(shell, prefix, script, COLCON_CURRENT_PREFIX=str(prefix))
    said, path = done.stdout.splitlines()
    assert (said, done.stderr) == ("it runs", "")
    assert path.replace(" ", ":").split(":").count(f"{prefix}/bin") == 1


@pytest.mark.parametrize("shell", ["sh", "zsh"])
@pytest.mark.parametrize("name", ["setup.bash", "local_setup.bash"])
def test_another_shell_is_told_to_use_bash(prefix, shell, name):
    done = sourced(shell, prefix, f". ./{name}; echo goes on")
    assert done.stdout == "goes on\n"
    assert done.stderr.startswith(f"turtlewire: {name} is for bash: type bash, then the same")
    assert done.stderr.count("\n") == 1


@needs_fish
def test_a_users_own_rosdep_cache_is_left_alone(prefix):
    cache = prefix / "home/.ros/rosdep/sources.cache"
    cache.mkdir(parents=True)
    (cache / "index").touch()
    assert fish(prefix, f'source {prefix}/setup.fish; echo "[$ROS_HOME]"') == ["[]"]


SHELLS = {"bash": ("--norc", "-i"), "zsh": ("-f", "-i"), "fish": ("--no-config", "-i")}


@pytest.fixture
def graph():
    """A node with a topic, and a transform."""
    transform = msg.get_message("geometry_msgs/msg/TransformStamped")(child_frame_id="some_frame_x")
    transform.header.frame_id = "world"
    context = open_context()
    node = context.create_node("some_node_x")
    node.create_publisher(
        "/some/topic_x", TypeId("std_msgs/msg/String", msg.type_hash("std_msgs/msg/String")), QoS()
    )
    tf = TypeId("tf2_msgs/msg/TFMessage", msg.type_hash("tf2_msgs/msg/TFMessage"))
    latched = node.create_publisher("/tf_static", tf, QoS(durability=Durability.TRANSIENT_LOCAL))
    latched.publish(
        msg.serialize(msg.get_message("tf2_msgs/msg/TFMessage")(transforms=[transform]))
    )
    yield
    context.close()


def type_until(terminal, line, shown):
    """Type a line again while it shows nothing: under load, a TAB gives up too soon."""
    for _ in range(20):
        terminal.type(line)
        with suppress(AssertionError):
            terminal.wait_for(shown, timeout=15)
            return
    raise AssertionError(terminal.text)


@pytest.mark.usefixtures("graph")
@pytest.mark.parametrize("shell", SHELLS)
def test_tab_completes_words_topics_nodes_and_frames(prefix, run, shell):
    if shutil.which(shell) is None:
        pytest.skip(f"needs {shell} (Debian: apt install {shell})")
    ros2 = prefix / "bin/ros2"
    ros2.parent.mkdir()
    ros2.write_text(
        f"#!{sys.executable}\n# PYTHON_ARGCOMPLETE_OK\nimport sys\nfrom ros2cli.main import "
        "main\nsys.exit(main())\n"
    )
    ros2.chmod(0o755)
    path = os.pathsep.join((str(ros2.parent), str(BIN), "/usr/bin", "/bin"))
    environment = {"HOME": str(prefix), "PATH": path, "TERM": "xterm", "PS1": "> "}
    terminal = run(shutil.which(shell), *SHELLS[shell], terminal=True, environment=environment)
    terminal.type(f"source {prefix}/setup.{shell}; echo sour''ced\n")
    terminal.wait_for("sourced")
    for line, shown in (
        ("ros2 topic typ\t /some/topic_x\n", "std_msgs/msg/String"),
        ("ros2 topic info /some/to\t\n", "Publisher count: 1"),
        ("ros2 node info /some_no\t\n", "/some_node_x"),
        ("ros2 run --prefix echo tf2_ros tf2_echo some_fra\t\n", "tf2_echo some_frame_x"),
    ):
        type_until(terminal, line, shown)
    terminal.type("exit\n")
    assert terminal.wait() == 0
